#include "mesher/input/table_rows.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d {
namespace {

using formats::in_quotes;
using formats::to_number;
using formats::trimmed;

std::optional<Colour> hexadecimal_colour(std::string_view text) {
  const std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  unsigned value = 0;
  const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  if ((digits.size() != 6 && digits.size() != 8) || end != digits.data() + digits.size()) {
    return std::nullopt;
  }
  value >>= digits.size() == 8 ? 8U : 0U;  // what follows is the opacity
  return Colour{static_cast<std::uint8_t>(value >> 16U), static_cast<std::uint8_t>(value >> 8U),
                static_cast<std::uint8_t>(value)};
}

/// A whole number, as "5" or, from spreadsheets, "5.0".
std::optional<Label> label_of(std::string_view text) {
  const auto number = to_number(text);
  if (!number || *number != std::floor(*number) || *number > std::numeric_limits<Label>::max() ||
      *number < std::numeric_limits<Label>::min()) {
    return std::nullopt;
  }
  return static_cast<Label>(*number);
}

}  // namespace

void TableRows::begin_line(std::size_t number, std::string_view text) {
  line_ = number;
  text_ = text;
}

void TableRows::fail(const std::string& what) const {
  throw InputError(subject_ + ": line " + std::to_string(line_) + " " + in_quotes(text_) + " " + what);
}

void TableRows::add(const std::string& number, const std::string& name, std::optional<Colour> colour) {
  const auto label = label_of(trimmed(number));
  if (!label) {
    fail("has no whole number where the label stands (" + in_quotes(number) +
         "); write label, name and colour, as 5 right-lung 200 80 80 255");
  }
  if (trimmed(name).empty()) {
    fail("has no name; write label, name and colour, as 5 right-lung 200 80 80 255");
  }
  const auto [known, is_new] = line_of_.try_emplace(*label, line_);
  if (!is_new) {
    fail("names label " + std::to_string(*label) + " a second time, after line " +
         std::to_string(known->second) + "; remove one of the two");
  }
  names_.set({.label = *label, .name = std::string(trimmed(name)), .colour = colour});
}

std::optional<Colour> TableRows::colour(const std::string& text) const {
  const std::string lower = formats::lower_case(trimmed(text));
  if (lower.empty() || lower == "n/a" || lower == "none") {
    return std::nullopt;
  }
  if (const auto colour = hexadecimal_colour(lower)) {
    return colour;
  }
  return colour(formats::words_of(lower, " \t\r,;[]()"));
}

std::optional<Colour> TableRows::colour(const std::vector<std::string>& numbers) const {
  Colour colour{};
  bool fractions = false;
  for (const std::string& number : numbers) {
    fractions = fractions || number.find('.') != std::string::npos;
  }
  bool is_good = numbers.size() == colour.size() || numbers.size() == colour.size() + 1;
  for (std::size_t n = 0; is_good && n < colour.size(); ++n) {
    const double value = to_number(trimmed(numbers[n])).value_or(-1) * (fractions ? 255 : 1);
    is_good = value >= 0 && value <= 255;
    colour[n] = is_good ? static_cast<std::uint8_t>(std::lround(value)) : std::uint8_t{0};
  }
  if (!is_good) {
    fail("has a colour that is none; write #rrggbb, or red, green and blue from 0 to 255");
  }
  return colour;
}

LabelNames TableRows::names() const {
  if (names_.empty()) {
    throw InputError(
        subject_ +
        ": it names no label; write label, name and colour in every line, as 5 right-lung 200 80 80 255");
  }
  return names_;
}

}  // namespace cbc3d

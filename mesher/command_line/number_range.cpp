#include "mesher/command_line/number_range.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

#include "mesher/core/one_line.hpp"

namespace cbc3d {
namespace {

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

/// True when the whole text, before which a plus may stand, is a number between the others.
template <typename Number>
bool is_between(const std::string& text, Number lowest, Number highest) {
  const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* const end = text.data() + text.size();
  Number number{};
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end && number >= lowest && number <= highest;
}

CLI::Validator validator(const std::string& range, const std::function<bool(const std::string&)>& is_good) {
  const auto check = [range, is_good](const std::string& text) {
    return is_good(text) ? std::string() : shortened(text) + ": give a " + range;
  };
  return CLI::Validator(check, "");
}

}  // namespace

CLI::Validator number_between(double lowest, double highest) {
  return validator("number from " + text_of(lowest) + " to " + text_of(highest),
                   [=](const std::string& text) { return is_between(text, lowest, highest); });
}

CLI::Validator whole_number_between(std::int64_t lowest, std::int64_t highest) {
  return validator("whole number from " + std::to_string(lowest) + " to " + std::to_string(highest),
                   [=](const std::string& text) { return is_between(text, lowest, highest); });
}

}  // namespace cbc3d

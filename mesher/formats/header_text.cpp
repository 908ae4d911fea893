#include "mesher/formats/header_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::size_t kMostLine = std::size_t{64} << 10U;
constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <typename T>
std::optional<T> whole(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& key, std::string_view text, const std::string& wanted) {
  throw FormatError("its header has " + key + " " + in_quotes(text) + ", which is not " + wanted +
                    "; repair its header");
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view{}
                                         : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::vector<std::string> words_of(std::string_view text, std::string_view separators) {
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(separators); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(separators, end);
  }
  return words;
}

std::optional<double> to_number(std::string_view text) {
  return whole<double>(text);
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  return whole<std::int64_t>(text);
}

std::vector<double> numbers_of(const std::string& key, std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    const auto number = to_number(word);
    if (!number || !std::isfinite(*number)) {
      refuse(key, word, "a finite number");
    }
    numbers.push_back(*number);
  }
  if (count != 0 && numbers.size() != count) {
    refuse(key, text, std::to_string(count) + " numbers");
  }
  return numbers;
}

std::vector<std::int64_t> integers_of(const std::string& key, std::string_view text, std::size_t count) {
  std::vector<std::int64_t> numbers;
  for (const std::string& word : words_of(text)) {
    const auto number = to_integer(word);
    if (!number) {
      refuse(key, word, "an integer");
    }
    numbers.push_back(*number);
  }
  if (count != 0 && numbers.size() != count) {
    refuse(key, text, std::to_string(count) + " integers");
  }
  return numbers;
}

std::size_t size_of(const std::string& key, std::int64_t value) {
  if (value < 1 || value > std::numeric_limits<std::int32_t>::max()) {
    refuse(key, std::to_string(value), "a number of voxels");
  }
  return static_cast<std::size_t>(value);
}

std::string number_text(double number) {
  char text[64];
  const auto [end, error] = std::to_chars(std::begin(text), std::end(text), number);
  return error == std::errc() ? std::string(std::begin(text), end) : "?";
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string shown(text.substr(0, kMost));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, '?');
  return "'" + shown + (text.size() > kMost ? "..." : "") + "'";
}

std::optional<std::string_view> Lines::next() {
  if (at_ >= text_.size()) {
    return std::nullopt;
  }
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  if (end - at_ > kMostLine) {
    throw FormatError("a line of its header has more than 65536 characters; it is damaged");
  }
  std::string_view line = text_.substr(at_, end - at_);
  at_ = end + 1;
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

}  // namespace cbc3d::formats

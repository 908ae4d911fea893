// Numbers and words of text headers, taken strictly: what is not wholly a number is none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cbc3d::formats {

/// Without blanks at both ends, carriage returns included.
std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);
/// The words between the separators (and blanks); none is empty.
std::vector<std::string> words_of(std::string_view text, std::string_view separators = " \t\r");

/// The number that the whole of `text` is, "nan" and "inf" among them; none otherwise.
std::optional<double> to_number(std::string_view text);
std::optional<std::int64_t> to_integer(std::string_view text);

/// All words of `text` as finite numbers, `count` of them (0: any number of them). Throws FormatError that
/// names `key`.
std::vector<double> numbers_of(const std::string& key, std::string_view text, std::size_t count);
std::vector<std::int64_t> integers_of(const std::string& key, std::string_view text, std::size_t count);
/// A size: an integer from 1 to 2^31 - 1. Throws FormatError.
std::size_t size_of(const std::string& key, std::int64_t value);

/// The shortest text that reads back as the number.
std::string number_text(double number);
/// For a message: at most 60 characters, in quotes, control characters as '?'.
std::string in_quotes(std::string_view text);

/// The lines of a header without their ends; those longer than 64 kB are refused with FormatError.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  /// The next line; none at the end of the text.
  std::optional<std::string_view> next();
  /// Where the next line begins in the text.
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace cbc3d::formats

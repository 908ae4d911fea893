#include "mesher/input/named_text.hpp"

#include <cctype>
#include <charconv>
#include <string_view>

namespace cbc3d {
namespace {

constexpr std::string_view kWord = "label ";

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

/// Whether what follows the character is in quotes, which end with the line; an apostrophe, as in "label's",
/// opens and closes none.
bool is_quoted_after(const std::string& text, std::size_t at, bool quoted) {
  if (text[at] == '\n') {
    return false;
  }
  if (text[at] != '\'') {
    return quoted;
  }
  const bool word_before = at > 0 && is_word_character(text[at - 1]);
  const bool word_after = at + 1 < text.size() && is_word_character(text[at + 1]);
  return quoted ? word_after : !word_before;
}

/// Where the number that begins here ends, and the number; the place itself where there is none.
std::size_t end_of_number(const std::string& text, std::size_t begin, Label& label) {
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data() + begin, end, label);
  const bool continues =
      after != end &&
      (is_word_character(*after) ||
       (*after == '.' && after + 1 != end && std::isdigit(static_cast<unsigned char>(after[1])) != 0));
  return error == std::errc() && !continues ? static_cast<std::size_t>(after - text.data()) : begin;
}

}  // namespace

std::string with_names(const std::string& text, const LabelNames& names) {
  std::string named;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size();) {
    quoted = is_quoted_after(text, at, quoted);
    const bool starts = !quoted && (at == 0 || !is_word_character(text[at - 1]));
    Label label = 0;
    const std::size_t number = at + kWord.size();
    const std::size_t end = starts && text.compare(at, kWord.size(), kWord) == 0 && number < text.size()
                                ? end_of_number(text, number, label)
                                : number;
    if (end > number) {
      named += names.text(label);
      at = end;
    } else {
      named += text[at++];
    }
  }
  return named;
}

}  // namespace cbc3d

// Messages for the terminal, whatever the names in them.
#pragma once

#include <algorithm>
#include <string>

namespace cbc3d {

/// What a message shows of a value at most.
inline constexpr std::size_t kMostShown = 40;

/// The value, or its beginning and "..." where it is longer than a message shows.
inline std::string shortened(const std::string& value) {
  return value.size() <= kMostShown ? value : value.substr(0, kMostShown - 3) + "...";
}

/// The text with the runs of such characters shortened.
template <typename IsOfRun>
std::string with_short_runs(const std::string& text, const IsOfRun& is_of_run) {
  std::string out;
  for (auto at = text.begin(); at != text.end();) {
    const auto end = std::find_if_not(at, text.end(), is_of_run);
    out += shortened(std::string(at, end));
    at = end;
    if (at != text.end()) out += *at++;
  }
  return out;
}

/// The text with every word shortened, for messages that have no names of files.
inline std::string with_short_words(const std::string& text) {
  return with_short_runs(text, [](char c) { return c != ' '; });
}

/// The text with '?' for every control character, as names of files may have them, and long numbers
/// shortened.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return with_short_runs(text, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace cbc3d

// Messages for the terminal, whatever the names in them.
#pragma once

#include <algorithm>
#include <string>

namespace cbc3d {

/// The text with '?' for every control character, as names of files may have them.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return text;
}

}  // namespace cbc3d

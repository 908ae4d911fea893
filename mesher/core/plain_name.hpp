// Names that become parts of file names.
#pragma once

#include <algorithm>
#include <string_view>

namespace cbc3d {

/// Several names and figures have to fit into the 255 bytes of a file name.
inline constexpr std::size_t kLongestName = 80;
/// What is_plain_name asks for, for messages.
inline constexpr const char* kPlainName = "1 to 80 letters, digits, hyphens and underscores";

/// True for ASCII letters, digits, hyphens and underscores alone, 1 to kLongestName of them.
inline bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

}  // namespace cbc3d

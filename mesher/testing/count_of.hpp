// How often a text says something.
#pragma once

#include <cstddef>
#include <string_view>

namespace cbc3d::testing {

/// How often the part stands in the text, counted from the left without overlaps. The part is not empty.
inline std::size_t count_of(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string_view::npos; at += part.size()) {
    ++found;
  }
  return found;
}

}  // namespace cbc3d::testing

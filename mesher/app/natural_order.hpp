// The order of file names that people expect: numbers in them count as numbers.
#pragma once

#include <string_view>

namespace cbc3d {

/// True when `a` comes before `b`: s2 before s10. Runs of digits are compared by their value, everything else
/// byte by byte; of two numbers of one value the one with fewer zeros in front comes first.
bool comes_before(std::string_view a, std::string_view b);

}  // namespace cbc3d

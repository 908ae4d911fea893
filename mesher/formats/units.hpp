// Units of length by their names.
#pragma once

#include <optional>
#include <string_view>

namespace cbc3d::formats {

/// Millimetres of a unit: "mm", "um", "micrometer", "micron", "cm", "m", "nm", "inch" and their spellings,
/// letter case ignored; none for other words.
std::optional<double> millimetres_of(std::string_view unit);

}  // namespace cbc3d::formats

// TIFF files of one page or several, by libtiff: what ITK's reader makes zeros of is read as it is or
// refused.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cbc3d {

/// A page of grey values: rows from the top, values in this machine's byte order.
struct TiffPage {
  enum class Value { uint8, int8, uint16, int16, uint32, int32, float32 };
  std::size_t width = 0, height = 0, channels = 1;  ///< channels of a pixel lie beside each other
  Value value = Value::uint8;
  std::vector<char> bytes;
};

/// True when the file begins like TIFF or BigTIFF.
bool is_tiff(const std::string& file);

/// Pages of the file. Throws InputError where it is damaged.
std::size_t count_tiff_pages(const std::string& file);

/// Reads a page, counted from 0. Throws InputError for a damaged file, a palette, inverted greys, tiles,
/// planes, and values that are no integers of 8, 16 or 32 bits nor floats of 32.
TiffPage read_tiff_page(const std::string& file, std::size_t number);

}  // namespace cbc3d

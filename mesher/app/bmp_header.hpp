// BMP pictures: whether a file has all that its header promises. ITK's reader makes up what a file lacks.
#pragma once

#include <string>

namespace cbc3d {

/// True when the file begins like BMP.
bool is_bmp(const std::string& file);

/// Throws InputError where the file ends before its last pixel, or its header promises none.
void require_whole_bmp(const std::string& file);

}  // namespace cbc3d

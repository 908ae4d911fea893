// The directories of a TIFF file: whether they, and all strips of pixels that they name, lie within the file.
// libtiff takes what a file lacks for the end of its pages.
#pragma once

#include <cstddef>
#include <string>

namespace cbc3d {

/// Pages of the TIFF or BigTIFF file. Throws InputError where a directory, a value of it or a strip lies
/// beyond the end of the file, and where directories follow each other in a circle.
std::size_t require_whole_tiff(const std::string& file);

}  // namespace cbc3d

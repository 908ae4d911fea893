// The header of an image file, whichever format it is of.
#pragma once

#include <filesystem>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// Recognises the format by the first bytes, not by the name, and reads the header; a file that is compressed
/// as a whole is recognised too, whatever its name. Throws FormatError, which names what the file is where it
/// is known but not read: pictures, HDF5 (MINC), VTK, an empty file.
ImageHeader read_image_header(const std::filesystem::path& path);

}  // namespace cbc3d::formats

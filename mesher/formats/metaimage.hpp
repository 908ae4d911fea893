// MetaImage: .mha with its voxels, .mhd with its voxels in other files.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one.
bool is_metaimage(std::string_view head);

/// The header that `head`, the beginning of `path`, begins with. Throws FormatError.
ImageHeader read_metaimage_header(std::string_view head, const std::filesystem::path& path);

}  // namespace cbc3d::formats

// MRtrix's images: .mif, .mif.gz, and .mih with its voxels in other files.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one.
bool is_mif(std::string_view head);

/// The header that `head`, the beginning of `path`, begins with; `path` is compressed as `encoding` says. The
/// axes of the image are the storage axes, whatever the layout. Throws FormatError.
ImageHeader read_mif_header(std::string_view head, const std::filesystem::path& path, Encoding encoding);

}  // namespace cbc3d::formats

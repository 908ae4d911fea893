// FreeSurfer's MGH (.mgh) and MGZ (.mgz), as its wiki describes them.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one and its name says that it is one: the beginning alone is weak.
bool is_mgh(std::string_view head, const std::filesystem::path& path);

/// The header that begins with `head`, the first bytes of `path`, which is compressed as `encoding` says.
/// Throws FormatError.
ImageHeader read_mgh_header(std::string_view head, const std::filesystem::path& path, Encoding encoding);

}  // namespace cbc3d::formats

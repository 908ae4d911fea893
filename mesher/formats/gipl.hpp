// GIPL, the Guy's Image Processing Lab format (.gipl, .gipl.gz).
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one.
bool is_gipl(std::string_view head);

/// The header that begins with `head`, the first bytes of `path`, which is compressed as `encoding` says. Its
/// axes are those of LPS space, as ITK takes them. Throws FormatError.
ImageHeader read_gipl_header(std::string_view head, const std::filesystem::path& path, Encoding encoding);

}  // namespace cbc3d::formats

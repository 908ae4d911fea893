// INRIMAGE-4 (.inr, .inr.gz), in which CGAL ships its example images.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one.
bool is_inrimage(std::string_view head);

/// The header that begins with `head`, the first bytes of `path`, which is compressed as `encoding` says. Its
/// axes are those of LPS space. Throws FormatError.
ImageHeader read_inrimage_header(std::string_view head, const std::filesystem::path& path, Encoding encoding);

}  // namespace cbc3d::formats

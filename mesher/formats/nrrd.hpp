// NRRD (teem.sourceforge.net/nrrd), attached (.nrrd) and detached (.nhdr), seg.nrrd among them.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one.
bool is_nrrd(std::string_view head);

/// The header that `head`, the beginning of `path`, is or begins with. `space` in every spelling of the
/// standard becomes LPS, `space units` and `units` mm. Throws FormatError.
ImageHeader read_nrrd_header(std::string_view head, const std::filesystem::path& path);

}  // namespace cbc3d::formats

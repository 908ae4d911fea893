// NIfTI-1 and -2 (nifti.nimh.nih.gov) and Analyze 7.5, each in one file or as a pair .hdr and .img.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when a file begins like one of them.
bool is_nifti(std::string_view head);

/// The header that begins with `head`, the first bytes of `path`, which is compressed as `encoding` says.
/// The frame is by the standard: the sform where its code is set, otherwise the qform, otherwise spacing
/// alone with a warning; right-anterior-superior becomes LPS, units mm. Throws FormatError.
ImageHeader read_nifti_header(std::string_view head, const std::filesystem::path& path, Encoding encoding);

}  // namespace cbc3d::formats

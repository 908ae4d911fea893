// Where an NRRD image lies, by the fields of its header.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// Fields of a header by their names in lower case without blanks.
using NrrdFields = std::map<std::string, std::string>;

/// Finds the three axes of space among all, and sets size and frame. Another axis with more
/// than one sample, before or behind all others, holds volumes or layers; colours, vectors and more axes are
/// refused. Throws FormatError.
void take_nrrd_frame(const NrrdFields& fields, const std::vector<std::int64_t>& sizes, ImageHeader& image);

}  // namespace cbc3d::formats

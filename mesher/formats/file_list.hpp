// Several files with the slices of one image, as NRRD and MetaImage name them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// True when words name files by number: a pattern such as "slice%03d.raw" and its first, last and step.
bool is_file_pattern(const std::vector<std::string>& words);

/// The names that such words give. The pattern has one %d, with a width or none, and nothing else of printf;
/// FormatError otherwise, and for more than 65536 files.
std::vector<std::string> names_of_pattern(const std::vector<std::string>& words);

/// Data files by their names beside the header. FormatError for an empty name.
std::vector<DataFile> files_beside(const std::filesystem::path& header,
                                   const std::vector<std::string>& names);

}  // namespace cbc3d::formats

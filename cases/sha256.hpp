// SHA-256 of a file.
#pragma once

#include <filesystem>
#include <string>

namespace cbc3d::cases {

/// Lower-case hexadecimal. Throws InputError when the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace cbc3d::cases

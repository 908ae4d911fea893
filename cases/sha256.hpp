// SHA-256 of a file or a text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cbc3d::cases {

/// Lower-case hexadecimal. Throws InputError when the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Lower-case hexadecimal.
std::string sha256_of_text(std::string_view text);

}  // namespace cbc3d::cases

// SHA-256 of a file or of any bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace cbc3d::cases {

/// The digest of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(const void* bytes, std::size_t count);
  /// Lower-case hexadecimal; nothing can be added after it.
  [[nodiscard]] std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Lower-case hexadecimal. Throws InputError when the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Lower-case hexadecimal.
std::string sha256_of_text(std::string_view text);

}  // namespace cbc3d::cases

// A text file that is written in large pieces, with numbers as short as they can be without loss.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

class TextFile {
 public:
  /// `digits`: significant digits of real numbers; 0: as many as their value needs. Throws WriteError.
  explicit TextFile(const std::filesystem::path& path, int digits = 0);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  /// Writes texts and numbers one after the other.
  template <typename... Parts>
  void add(const Parts&... parts) {
    (add_one(parts), ...);
    if (buffer_.size() > kPiece) flush();
  }
  /// Writes three coordinates with `separator` between them.
  void add_point(const Vec3& p, std::string_view separator) { add(p.x, separator, p.y, separator, p.z); }
  void add_bytes(std::span<const std::byte> bytes) {
    add(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  /// Throws WriteError where anything could not be written.
  void close();

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 20U;

  void add_one(std::string_view text) { buffer_ += text; }
  void add_one(char c) { buffer_ += c; }
  void add_one(std::integral auto number) {
    char text[24];
    buffer_.append(text, std::to_chars(text, text + sizeof text, number).ptr);
  }
  void add_one(double number) {
    char text[32];
    const auto end =
        digits_ == 0 ? std::to_chars(text, text + sizeof text, number)
                     : std::to_chars(text, text + sizeof text, number, std::chars_format::general, digits_);
    buffer_.append(text, end.ptr);
  }
  void flush();
  void note_failure();

  std::filesystem::path path_;
  std::FILE* file_;
  int digits_;
  std::string buffer_;
  bool failed_ = false;
  int error_ = 0;  ///< errno of the first failure
};

}  // namespace cbc3d

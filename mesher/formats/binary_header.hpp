// Fields of binary headers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace cbc3d::formats {

/// Numbers at fixed places of a header of either byte order. Places beyond its end are the caller's fault:
/// every format checks the length of its header first.
class BinaryHeader {
 public:
  BinaryHeader(std::string_view bytes, bool big_endian)
      : bytes_(bytes), swapped_(big_endian != (std::endian::native == std::endian::big)) {}

  template <typename T>
  [[nodiscard]] T get(std::size_t at) const {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.substr(at, sizeof(T)).data(), bytes_.substr(at, sizeof(T)).size());
    if (swapped_) {
      std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
  }

 private:
  std::string_view bytes_;
  bool swapped_;
};

}  // namespace cbc3d::formats

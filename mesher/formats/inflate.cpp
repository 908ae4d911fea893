#include "mesher/formats/inflate.hpp"

#include <libdeflate.h>

#include <memory>

namespace cbc3d {

bool inflate_gzip(std::span<const std::uint8_t> file, std::span<std::uint8_t> out) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (decompressor == nullptr || file.empty()) {
    return false;
  }
  while (!file.empty()) {
    std::size_t read = 0;
    std::size_t written = 0;
    if (libdeflate_gzip_decompress_ex(decompressor.get(), file.data(), file.size(), out.data(), out.size(),
                                      &read, &written) != LIBDEFLATE_SUCCESS) {
      return false;
    }
    file = file.subspan(read);
    out = out.subspan(written);
  }
  return out.empty();
}

}  // namespace cbc3d

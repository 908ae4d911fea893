#include "mesher/core/inflate.hpp"

#include <libdeflate.h>
#include <zlib.h>

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

bool inflate_gzip_begin(std::span<const std::uint8_t> file, std::span<std::uint8_t> out) {
  constexpr int kGzip = 16;  // zlib expects gzip's header when this is added to the window's bits
  z_stream stream{};
  if (inflateInit2(&stream, MAX_WBITS + kGzip) != Z_OK) {
    return false;
  }
  stream.next_in = const_cast<Bytef*>(file.data());
  stream.avail_in = static_cast<uInt>(file.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_SYNC_FLUSH);
  inflateEnd(&stream);
  return stream.avail_out == 0;
}

}  // namespace cbc3d

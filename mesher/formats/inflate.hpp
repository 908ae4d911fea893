// Decompression of gzip files whose size is known, by libdeflate: twice as fast as zlib, which reads piece by
// piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cbc3d {

/// Decompresses a gzip file (RFC 1952; one member or several) of exactly `out.size()` bytes. False when it
/// is not one, is damaged or has another size; what `out` holds then means nothing.
[[nodiscard]] bool inflate_gzip(std::span<const std::uint8_t> file, std::span<std::uint8_t> out);

}  // namespace cbc3d

// Bytes of a file as they lie there or decompressed, with the checks that the compression offers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// A source of bytes. What it throws is FormatError.
class ByteStream {
 public:
  ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  virtual ~ByteStream() = default;
  /// Fills `out` and returns how many bytes it wrote: fewer only where the source has ended. A compressed
  /// source that breaks off, fails its check sum or is followed by other data throws. The check sum stands
  /// behind the last byte, so that one byte more has to be asked for.
  virtual std::size_t read(std::span<std::uint8_t> out) = 0;
};

/// The bytes of `path` from `begin` on, at most `length` of them (0: all), as they lie there (raw),
/// or decompressed: gzip of one member or several, zlib's format too, or bzip2.
std::unique_ptr<ByteStream> open_stream(const std::filesystem::path& path, std::uint64_t begin,
                                        std::uint64_t length, Encoding encoding);

/// Gzip, bzip2 or raw by the first bytes of a file. Throws FormatError where it cannot be opened.
Encoding encoding_of_file(const std::filesystem::path& path);

/// The first bytes of a file, decompressed where it is compressed as a whole; fewer than `most` where it
/// ends.
std::string head_of_file(const std::filesystem::path& path, Encoding encoding, std::size_t most);

}  // namespace cbc3d::formats

#include "mesher/app/bmp_header.hpp"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kHeader = 54;  // bytes of both headers of nearly every BMP
constexpr std::uint32_t kOldInfo = 12, kInfo = 40;
enum class Compression : std::uint32_t { none = 0, rle8 = 1, rle4 = 2, bitfields = 3 };

/// Fields of the two headers, lowest byte first.
struct Header {
  std::uint64_t first_pixel = 0, width = 0, height = 0, bits = 0;
  Compression compression = Compression::none;
};

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw InputError("cannot read '" + file + "': " + what + "; copy it again");
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < count; ++n) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + n])} << 8U * n;
  }
  return value;
}

/// The magnitude of a signed number of 32 bits: rows from the top have a negative height.
std::uint64_t magnitude_at(const std::string& bytes, std::size_t at) {
  return static_cast<std::uint64_t>(
      std::abs(std::int64_t{static_cast<std::int32_t>(number_at(bytes, at, 4))}));
}

std::string head_of(const std::string& file) {
  std::string bytes(kHeader, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(kHeader));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

Header header_of(const std::string& file) {
  const std::string bytes = head_of(file);
  if (bytes.size() < kHeader) {
    fail(file, "a BMP image that ends within its header");
  }
  Header header{.first_pixel = number_at(bytes, 10, 4), .compression = Compression::none};
  const std::uint32_t info = number_at(bytes, 14, 4);
  if (info == kOldInfo) {
    header.width = number_at(bytes, 18, 2);
    header.height = number_at(bytes, 20, 2);
    header.bits = number_at(bytes, 24, 2);
  } else {
    header.width = magnitude_at(bytes, 18);
    header.height = magnitude_at(bytes, 22);
    header.bits = number_at(bytes, 28, 2);
    header.compression = static_cast<Compression>(number_at(bytes, 30, 4));
  }
  if (header.width == 0 || header.height == 0 || header.bits == 0 || header.bits > 32 ||
      (info != kOldInfo && info < kInfo) || header.first_pixel < 14 + std::uint64_t{info}) {
    fail(file, "a BMP image whose header promises no pixels");
  }
  return header;
}

/// Runs of equal pixels and pixels as they are, row by row; true where the last pixel is reached or the end
/// is marked.
bool has_all_runs(const Header& header, std::istream& in) {
  std::uint64_t x = 0, y = 0;
  while (y < header.height && !(y + 1 == header.height && x >= header.width)) {
    const int count = in.get(), value = in.get();
    if (!in || (count == 0 && value == 1)) {
      return static_cast<bool>(in);
    }
    if (count > 0) {
      x += static_cast<std::uint64_t>(count);
    } else if (value == 0) {
      x = 0;
      ++y;
    } else if (value == 2) {  // a step to the right and up
      x += static_cast<std::uint64_t>(in.get());
      y += static_cast<std::uint64_t>(in.get());
    } else {
      x += static_cast<std::uint64_t>(value);
      const int bytes = header.compression == Compression::rle4 ? (value + 1) / 2 : value;
      in.ignore(bytes + bytes % 2);
    }
  }
  return static_cast<bool>(in) && !in.eof();
}

}  // namespace

bool is_bmp(const std::string& file) {
  return head_of(file).starts_with("BM");
}

void require_whole_bmp(const std::string& file) {
  const Header header = header_of(file);
  const std::uint64_t length = std::filesystem::file_size(file);
  if (header.compression == Compression::rle8 || header.compression == Compression::rle4) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(header.first_pixel));
    if (header.first_pixel >= length || !has_all_runs(header, in)) {
      fail(file, "a truncated BMP image");
    }
    return;
  }
  const std::uint64_t row = (header.width * header.bits + 31) / 32 * 4;
  if (length < header.first_pixel || (length - header.first_pixel) / row < header.height) {
    fail(file, "a truncated BMP image: its header promises " + std::to_string(header.height) + " rows of " +
                   std::to_string(row) + " bytes from byte " + std::to_string(header.first_pixel) +
                   ", but it has " + std::to_string(length) + " bytes");
  }
}

}  // namespace cbc3d

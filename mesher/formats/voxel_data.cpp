#include "mesher/formats/voxel_data.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/component_type.hpp"
#include "mesher/formats/header_text.hpp"
#include "mesher/formats/inflate.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

std::uint64_t length_of(const DataFile& file) {
  std::error_code error;
  if (!fs::is_regular_file(file.path, error)) {
    throw FormatError(
        "its voxels lie in '" + file.path.string() + "', which is " +
        (fs::exists(file.path, error) ? "no file; repair its header" : "not there; put it there"));
  }
  const std::uintmax_t length = fs::file_size(file.path, error);
  if (error) {
    throw FormatError("'" + file.path.string() + "' cannot be read (" + error.message() + ")");
  }
  return length;
}

std::size_t bytes_per_file(const ImageHeader& header) {
  const std::size_t bytes = voxel_bytes(header);
  if (header.files.empty() || bytes % header.files.size() != 0) {
    throw FormatError("its voxels lie in " + std::to_string(header.files.size()) +
                      " files, over which its slices cannot be spread evenly; repair its header");
  }
  return bytes / header.files.size();
}

[[noreturn]] void refuse_length(std::uint64_t promised, std::uint64_t found) {
  throw FormatError("its header promises " + std::to_string(promised) +
                    " bytes of voxels, but the file has " + std::to_string(found) +
                    (found < promised ? "; it is truncated, copy it again"
                                      : "; its header or the file is damaged, write it again"));
}

/// What follows the last voxel: nothing, zeros, which are padding, or a fault.
void require_end(ImageHeader& header, ByteStream& stream, std::uint64_t promised) {
  std::vector<std::uint8_t> piece(std::size_t{1} << 16U);
  std::uint64_t more = 0;
  bool zeros = true;
  while (const std::size_t got = stream.read(piece)) {
    more += got;
    zeros = zeros && std::all_of(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got),
                                 [](std::uint8_t b) { return b == 0; });
  }
  if (more > 0 && !zeros) {
    refuse_length(promised, promised + more);
  }
  if (more > 0) {
    header.warnings.push_back(std::to_string(more) +
                              " zero bytes follow the last voxel that its header promises");
  }
}

/// The offset at which the voxels begin in a file as it lies on the disk, lines skipped.
std::uint64_t begin_of(const DataFile& file) {
  std::uint64_t at = file.begin;
  const auto stream = open_stream(file.path, at, 0, Encoding::raw);
  for (std::uint64_t lines = 0; lines < file.skipped_lines;) {
    std::uint8_t byte = 0;
    if (stream->read({&byte, 1}) == 0) {
      throw FormatError("its voxels begin after line " + std::to_string(file.skipped_lines) +
                        ", but the file has " + std::to_string(lines) + "; copy it again");
    }
    ++at;
    lines += byte == '\n' ? 1 : 0;
  }
  return at;
}

void skip(ByteStream& stream, std::uint64_t bytes) {
  std::vector<std::uint8_t> piece(std::size_t{1} << 16U);
  while (bytes > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, piece.size()));
    if (stream.read(std::span(piece).first(wanted)) != wanted) {
      throw FormatError("it ends before its first voxel (truncated); copy it again");
    }
    bytes -= wanted;
  }
}

std::uint64_t first_byte(const DataFile& file, std::uint64_t promised) {
  const std::uint64_t length = length_of(file);
  if (file.at_end) {
    return length >= promised ? length - promised : 0;
  }
  const std::uint64_t begin = begin_of(file);
  return file.skipped_bytes > length ? length : begin + file.skipped_bytes;
}

std::unique_ptr<ByteStream> open_voxels(const ImageHeader& header, const DataFile& file,
                                        std::uint64_t promised) {
  if (header.encoding == Encoding::gzip || header.encoding == Encoding::bzip2) {
    auto stream = open_stream(file.path, begin_of(file), file.packed_bytes, header.encoding);
    skip(*stream, file.skipped_bytes);
    return stream;
  }
  return open_stream(file.path, first_byte(file, promised), 0, Encoding::raw);
}

void read_bytes(ImageHeader& header, const DataFile& file, std::span<std::uint8_t> out) {
  const auto stream = open_voxels(header, file, out.size());
  const std::size_t got = stream->read(out);
  if (got != out.size()) {
    refuse_length(out.size(), got);
  }
  if (!file.may_continue) {
    require_end(header, *stream, out.size());
  }
}

/// The rest of a stream as text.
std::string rest_of(ByteStream& stream) {
  std::string text;
  std::vector<std::uint8_t> piece(std::size_t{1} << 20U);
  while (const std::size_t got = stream.read(piece)) {
    text.append(reinterpret_cast<const char*>(piece.data()), got);
  }
  return text;
}

constexpr std::string_view kBetweenValues = " \t\r\n,;";

template <typename T>
void parse_values(const std::string& text, std::span<std::uint8_t> out) {
  const std::size_t count = out.size() / sizeof(T);
  std::size_t at = text.find_first_not_of(kBetweenValues), read = 0;
  for (; at != std::string::npos; ++read) {
    const std::size_t end = std::min(text.find_first_of(kBetweenValues, at), text.size());
    T value{};
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, value);
    if (error != std::errc() || stop != text.data() + end) {
      throw FormatError("it has the value " + in_quotes(text.substr(at, end - at)) +
                        " among its voxels, which its type cannot hold; repair it");
    }
    if (read < count) {
      std::memcpy(out.data() + read * sizeof(T), &value, sizeof(T));
    }
    at = text.find_first_not_of(kBetweenValues, end);
  }
  if (read != count) {
    throw FormatError("its header promises " + std::to_string(count) + " values, but the file has " +
                      std::to_string(read) + "; copy it again");
  }
}

/// Small integers are parsed as wider ones, for their types are characters to the library.
template <typename T>
void parse_small_values(const std::string& text, std::span<std::uint8_t> out) {
  std::vector<std::uint8_t> wide(out.size() * sizeof(int));
  parse_values<int>(text, wide);
  for (std::size_t v = 0; v < out.size(); ++v) {
    int value = 0;
    std::memcpy(&value, wide.data() + v * sizeof(int), sizeof(int));
    if (value < std::numeric_limits<T>::min() || value > std::numeric_limits<T>::max()) {
      throw FormatError("it has the value " + std::to_string(value) +
                        " among its voxels, which its type cannot hold; repair it");
    }
    out[v] = static_cast<std::uint8_t>(static_cast<T>(value));
  }
}

void parse_text(Component component, const std::string& text, std::span<std::uint8_t> out) {
  with_type(component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    if constexpr (sizeof(T) == 1) {
      parse_small_values<T>(text, out);
    } else {
      parse_values<T>(text, out);
    }
  });
}

void parse_hex(const std::string& text, std::span<std::uint8_t> out) {
  std::size_t digits = 0;
  std::fill(out.begin(), out.end(), std::uint8_t{0});
  for (const char c : text) {
    if (std::string_view(" \t\r\n").find(c) != std::string_view::npos) {
      continue;
    }
    const char pair[] = {c};
    unsigned value = 0;
    if (std::from_chars(pair, pair + 1, value, 16).ec != std::errc()) {
      throw FormatError("its hexadecimal voxels have the character " + in_quotes({&c, 1}) + "; repair it");
    }
    if (digits / 2 < out.size()) {
      out[digits / 2] = static_cast<std::uint8_t>(out[digits / 2] << 4U | value);
    }
    ++digits;
  }
  if (digits != 2 * out.size()) {
    refuse_length(out.size(), digits / 2);
  }
}

/// A last value of which digits were cut off is a value too, unless something stands behind it.
void warn_of_open_end(ImageHeader& header, const std::string& text) {
  if (!text.empty() && kBetweenValues.find(text.back()) == std::string_view::npos) {
    header.warnings.push_back(
        "no end of line follows its last value, so that it is not known whether digits of that are missing");
  }
}

void read_text(ImageHeader& header, const DataFile& file, std::span<std::uint8_t> out) {
  const auto stream = open_voxels(header, file, out.size());
  const std::string text = rest_of(*stream);
  if (header.encoding == Encoding::hex) {
    parse_hex(text, out);
  } else {
    parse_text(header.component, text, out);
    warn_of_open_end(header, text);
  }
}

bool is_text(const ImageHeader& header) {
  return header.encoding == Encoding::ascii || header.encoding == Encoding::hex;
}

bool has_other_byte_order(const ImageHeader& header) {
  return bytes_of(header.component) > 1 && header.encoding != Encoding::ascii &&
         header.big_endian != (std::endian::native == std::endian::big);
}

void swap_bytes(std::span<std::uint8_t> bytes, std::size_t component_bytes) {
  const std::size_t count = bytes.size() / component_bytes;
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < count; ++v) {
    std::reverse(bytes.data() + v * component_bytes, bytes.data() + (v + 1) * component_bytes);
  }
}

/// A gzip file at once, which is twice as fast; false when it is not just as long as promised, or damaged.
bool read_at_once(const ImageHeader& header, std::span<std::uint8_t> buffer) {
  if (header.encoding != Encoding::gzip || header.files.size() != 1 ||
      lead_bytes(header) != header.files[0].skipped_bytes) {
    return false;
  }
  const DataFile& file = header.files[0];
  const std::uint64_t begin = begin_of(file);
  const std::uint64_t length = length_of(file);
  std::vector<std::uint8_t> packed(length > begin ? length - begin : 0);
  return open_stream(file.path, begin, file.packed_bytes, Encoding::raw)->read(packed) == packed.size() &&
         inflate_gzip(packed, buffer);
}

/// The most bytes that so many bytes of a file can hold of voxels.
double most_bytes(const ImageHeader& header, std::uint64_t length) {
  constexpr double kMostDeflate = 1100, kMostBzip2 = 2e6, kHarmless = 1 << 26;
  const auto bytes = static_cast<double>(length);
  switch (header.encoding) {
    case Encoding::gzip:
      return kHarmless + kMostDeflate * bytes;
    case Encoding::bzip2:
      return kHarmless + kMostBzip2 * bytes;
    default:  // each value of text has a digit and a blank
      return (bytes + 1) / 2 * static_cast<double>(bytes_of(header.component));
  }
}

}  // namespace

void require_plausible_length(ImageHeader& header) {
  const std::size_t promised = bytes_per_file(header);
  for (const DataFile& file : header.files) {
    const std::uint64_t length = length_of(file);
    if (header.encoding != Encoding::raw) {
      if (static_cast<double>(promised) > most_bytes(header, length)) {
        refuse_length(promised, length);
      }
      continue;
    }
    const std::uint64_t begin = first_byte(file, promised);
    const std::uint64_t found = length > begin ? length - begin : 0;
    if (found < promised) {
      refuse_length(promised, found);
    }
    if (found > promised && !file.may_continue) {
      require_end(header, *open_stream(file.path, begin + promised, 0, Encoding::raw), promised);
    }
  }
}

std::size_t lead_bytes(const ImageHeader& header) {
  constexpr std::uint64_t kMostLead = std::uint64_t{1} << 24U;
  if (header.encoding != Encoding::gzip || header.files.size() != 1) {
    return 0;
  }
  const std::uint64_t lead = header.files[0].skipped_bytes;
  return lead % 8 == 0 && lead <= kMostLead ? static_cast<std::size_t>(lead) : 0;
}

void read_voxels(ImageHeader& header, std::span<std::uint8_t> buffer) {
  const std::span<std::uint8_t> voxels = buffer.subspan(lead_bytes(header));
  if (!read_at_once(header, buffer)) {
    const std::size_t each = bytes_per_file(header);
    for (std::size_t f = 0; f < header.files.size(); ++f) {
      const auto part = voxels.subspan(f * each, each);
      is_text(header) ? read_text(header, header.files[f], part) : read_bytes(header, header.files[f], part);
    }
  }
  if (has_other_byte_order(header)) {
    swap_bytes(voxels, bytes_of(header.component));
  }
}

std::optional<std::uint64_t> offset_in_place(const ImageHeader& header) {
  if (header.encoding != Encoding::raw || header.files.size() != 1 || has_other_byte_order(header)) {
    return std::nullopt;
  }
  const std::uint64_t begin = first_byte(header.files[0], voxel_bytes(header));
  return begin % bytes_of(header.component) == 0 ? std::optional(begin) : std::nullopt;
}

}  // namespace cbc3d::formats

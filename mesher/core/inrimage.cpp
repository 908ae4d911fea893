#include "mesher/core/inrimage.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kHeaderBlock = 256;

using Fields = std::map<std::string, std::string>;

struct GzipCloser {
  void operator()(gzFile_s* file) const { gzclose(file); }
};
using GzipFile = std::unique_ptr<gzFile_s, GzipCloser>;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

/// The header is text in whole blocks of 256 bytes and ends with "##}\n".
std::string read_header(gzFile_s* file, const std::filesystem::path& path) {
  std::string header;
  while (header.find("##}") == std::string::npos) {
    char block[kHeaderBlock];
    if (header.size() > 64 * kHeaderBlock ||
        gzread(file, block, kHeaderBlock) != static_cast<int>(kHeaderBlock)) {
      fail(path, "not an INRIMAGE-4 file (its header does not end); convert it to NIfTI or NRRD");
    }
    header.append(block, kHeaderBlock);
    if (header.rfind("#INRIMAGE", 0) != 0) {
      fail(path, "not an INRIMAGE-4 file (it does not begin with #INRIMAGE); convert it to NIfTI or NRRD");
    }
  }
  return header;
}

Fields parse_fields(const std::string& header) {
  Fields fields;
  std::istringstream lines(header);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos && line[0] != '#') {
      fields[line.substr(0, equals)] = line.substr(equals + 1);
    }
  }
  return fields;
}

double number(const Fields& fields, const std::string& key, double otherwise,
              const std::filesystem::path& path) {
  const auto found = fields.find(key);
  if (found == fields.end()) {
    return otherwise;
  }
  try {
    return std::stod(found->second);
  } catch (const std::exception&) {
    fail(path, "its header has " + key + "=" + found->second + ", which is not a number");
  }
}

ImageFrame frame_of(const Fields& fields, const std::filesystem::path& path) {
  ImageFrame frame;
  const char* const sizes[] = {"XDIM", "YDIM", "ZDIM"};
  const char* const spacings[] = {"VX", "VY", "VZ"};
  const char* const translations[] = {"TX", "TY", "TZ"};
  for (int axis = 0; axis < 3; ++axis) {
    frame.size[static_cast<std::size_t>(axis)] = static_cast<int>(number(fields, sizes[axis], 1, path));
    frame.spacing_mm[axis] = number(fields, spacings[axis], 1.0, path);
    frame.origin_mm[axis] = number(fields, translations[axis], 0.0, path);
  }
  if (number(fields, "VDIM", 1, path) != 1) {
    fail(path,
         "it has VDIM=" + fields.at("VDIM") + " values per voxel; give an image with one label per voxel");
  }
  if (std::min({frame.size[0], frame.size[1], frame.size[2]}) < 1 || frame.spacing_mm.min_coeff() <= 0) {
    fail(path, "its header has a size or spacing that is not positive");
  }
  return frame;
}

InrimageVolume::Voxel type_of(const Fields& fields, int bits, const std::filesystem::path& path) {
  using Voxel = InrimageVolume::Voxel;
  const auto found = fields.find("TYPE");
  const std::string type = found != fields.end() ? found->second : "";
  const bool is_signed = type.starts_with("signed");
  if (type.starts_with("float") && (bits == 32 || bits == 64)) {
    return bits == 64 ? Voxel::float64 : Voxel::float32;
  }
  switch (type.starts_with("float") ? 0 : bits) {
    case 8:
      return is_signed ? Voxel::int8 : Voxel::uint8;
    case 16:
      return is_signed ? Voxel::int16 : Voxel::uint16;
    case 32:
      return is_signed ? Voxel::int32 : Voxel::uint32;
    default:
      fail(path, "its pixel type is TYPE=" + type + " PIXSIZE=" + std::to_string(bits) +
                     "; known are 8, 16 and 32-bit integers and 32 and 64-bit floats");
  }
}

bool is_of_other_byte_order(const Fields& fields) {
  const auto found = fields.find("CPU");
  const bool little = found == fields.end() || (found->second != "sun" && found->second != "sgi");
  return little != (std::endian::native == std::endian::little);
}

std::size_t bytes_of(InrimageVolume::Voxel type) {
  using Voxel = InrimageVolume::Voxel;
  switch (type) {
    case Voxel::uint8:
    case Voxel::int8:
      return 1;
    case Voxel::uint16:
    case Voxel::int16:
      return 2;
    case Voxel::float64:
      return 8;
    default:
      return 4;
  }
}

void swap_bytes(std::uint8_t* bytes, std::size_t count, std::size_t component_bytes) {
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < count; ++v) {
    std::reverse(bytes + v * component_bytes, bytes + (v + 1) * component_bytes);
  }
}

/// Reads what follows the header; `file` stands at its end.
void read_voxels(gzFile_s* file, std::uint8_t* bytes, std::size_t count, const std::filesystem::path& path) {
  for (std::size_t done = 0; done < count;) {
    const auto chunk = static_cast<unsigned>(std::min<std::size_t>(count - done, 1U << 28U));
    const int got = gzread(file, bytes + done, chunk);
    if (got <= 0) {
      fail(path, "the file ends before its last voxel (truncated); copy it again");
    }
    done += static_cast<std::size_t>(got);
  }
}

}  // namespace

bool has_inrimage_extension(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".inr") || name.ends_with(".inr.gz");
}

InrimageVolume read_inrimage(const std::filesystem::path& path) {
  const GzipFile file(gzopen(path.c_str(), "rb"));  // reads plain files as well
  if (!file) {
    fail(path, "the file cannot be opened; check its name and permissions");
  }
  const std::string header = read_header(file.get(), path);
  const Fields fields = parse_fields(header);
  const ImageFrame frame = frame_of(fields, path);
  const int bits = static_cast<int>(number(fields, "PIXSIZE", 8, path));  // "8 bits": the number comes first
  const InrimageVolume::Voxel type = type_of(fields, bits, path);
  const std::size_t count = frame.voxel_count(), component_bytes = bytes_of(type);
  InrimageVolume volume{frame, type, VoxelBytes(header.size(), count * component_bytes)};
  if (path.extension() != ".gz" || !volume.bytes.fill_from_gzip(path)) {
    read_voxels(file.get(), volume.bytes.data(), count * component_bytes, path);
  }
  if (is_of_other_byte_order(fields)) {
    swap_bytes(volume.bytes.data(), count, component_bytes);
  }
  return volume;
}

}  // namespace cbc3d

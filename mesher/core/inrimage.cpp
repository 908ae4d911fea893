#include "mesher/core/inrimage.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
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
    fail(path, "it has VDIM=" + fields.at("VDIM") + " values a voxel; give an image with one label a voxel");
  }
  if (std::min({frame.size[0], frame.size[1], frame.size[2]}) < 1 || frame.spacing_mm.min_coeff() <= 0) {
    fail(path, "its header has a size or spacing that is not positive");
  }
  return frame;
}

template <typename T>
void convert(const std::vector<char>& bytes, bool swap, std::vector<double>& values) {
  for (std::size_t v = 0; v < values.size(); ++v) {
    char one[sizeof(T)];
    std::memcpy(one, bytes.data() + v * sizeof(T), sizeof(T));
    if (swap) {
      std::reverse(one, one + sizeof(T));
    }
    T value;
    std::memcpy(&value, one, sizeof(T));
    values[v] = static_cast<double>(value);
  }
}

void convert_typed(const Fields& fields, int bits, const std::vector<char>& bytes,
                   std::vector<double>& values, const std::filesystem::path& path) {
  const auto text = [&fields](const char* key) {
    return fields.count(key) != 0 ? fields.at(key) : std::string();
  };
  const bool file_little = text("CPU") != "sun" && text("CPU") != "sgi";
  const bool swap = file_little != (std::endian::native == std::endian::little);
  const std::string type = text("TYPE");
  const bool is_signed = type.rfind("signed", 0) == 0;
  if (type.rfind("float", 0) == 0) {
    bits == 64 ? convert<double>(bytes, swap, values) : convert<float>(bytes, swap, values);
  } else if (bits == 8) {
    is_signed ? convert<std::int8_t>(bytes, swap, values) : convert<std::uint8_t>(bytes, swap, values);
  } else if (bits == 16) {
    is_signed ? convert<std::int16_t>(bytes, swap, values) : convert<std::uint16_t>(bytes, swap, values);
  } else if (bits == 32) {
    is_signed ? convert<std::int32_t>(bytes, swap, values) : convert<std::uint32_t>(bytes, swap, values);
  } else {
    fail(path, "its pixel type is TYPE=" + type + " PIXSIZE=" + text("PIXSIZE") +
                   "; known are 8, 16 and 32-bit integers and 32 and 64-bit floats");
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
  const Fields fields = parse_fields(read_header(file.get(), path));
  InrimageVolume volume;
  volume.frame = frame_of(fields, path);
  volume.values.resize(volume.frame.voxel_count());
  const int bits = static_cast<int>(number(fields, "PIXSIZE", 8, path));  // "8 bits": the number comes first
  std::vector<char> bytes(volume.values.size() * static_cast<std::size_t>(std::max(8, bits)) / 8);
  for (std::size_t done = 0; done < bytes.size();) {
    const auto chunk = static_cast<unsigned>(std::min<std::size_t>(bytes.size() - done, 1U << 28U));
    const int got = gzread(file.get(), bytes.data() + done, chunk);
    if (got <= 0) {
      fail(path, "the file ends before its last voxel (truncated); copy it again");
    }
    done += static_cast<std::size_t>(got);
  }
  convert_typed(fields, bits, bytes, volume.values, path);
  return volume;
}

}  // namespace cbc3d

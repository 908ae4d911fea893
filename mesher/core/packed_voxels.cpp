#include "mesher/core/packed_voxels.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "mesher/core/inflate.hpp"
#include "mesher/core/nrrd_header.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kNiftiHeader = 352;

/// The bytes of the file from `begin` on; empty when it cannot be read.
std::vector<std::uint8_t> bytes_of_file(const fs::path& path, std::size_t begin) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error || size < begin) {
    return {};
  }
  std::vector<std::uint8_t> bytes(size - begin);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(begin));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in ? bytes : std::vector<std::uint8_t>{};
}

template <typename T>
T field(std::span<const std::uint8_t> header, std::size_t at) {
  T value;
  std::memcpy(&value, header.data() + at, sizeof(T));
  return value;
}

/// The offset of the first voxel in the decompressed file; 0 when the voxels are not as asked for.
std::size_t nifti_offset(std::span<const std::uint8_t> header, std::size_t component_bytes) {
  const bool known = field<std::int32_t>(header, 0) == 348 && std::memcmp(header.data() + 344, "n+1", 4) == 0;
  const bool whole = field<std::int16_t>(header, 72) == static_cast<int>(8 * component_bytes);
  const auto slope = field<float>(header, 112);
  const bool as_it_is = slope == 0 || (slope == 1 && field<float>(header, 116) == 0);
  const auto offset = field<float>(header, 108);
  if (!known || !whole || !as_it_is || !(offset >= kNiftiHeader && offset < 1e6F)) {
    return 0;
  }
  const auto bytes = static_cast<std::size_t>(offset);
  return bytes % component_bytes == 0 ? bytes : 0;
}

template <typename T>
void zero_what_is_no_number(std::uint8_t* bytes, std::size_t count) {
  auto* const values = reinterpret_cast<T*>(bytes);
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < count; ++v) {
    values[v] = std::isfinite(values[v]) ? values[v] : T{0};
  }
}

std::optional<VoxelBytes> unpack_nifti(const fs::path& path, std::size_t bytes, std::size_t component_bytes,
                                       bool floating) {
  std::array<std::uint8_t, kNiftiHeader> header{};
  const std::vector<std::uint8_t> file = bytes_of_file(path, 0);
  const std::size_t offset =
      inflate_gzip_begin(file, header) ? nifti_offset(header, component_bytes) : std::size_t{0};
  VoxelBytes voxels(offset, offset == 0 ? 0 : bytes);
  if (offset == 0 || !voxels.fill_from_gzip(file)) {
    return std::nullopt;
  }
  if (floating) {  // as the NIfTI library does
    component_bytes == 4 ? zero_what_is_no_number<float>(voxels.data(), bytes / 4)
                         : zero_what_is_no_number<double>(voxels.data(), bytes / 8);
  }
  return voxels;
}

std::optional<VoxelBytes> unpack_nrrd(const fs::path& path, std::size_t bytes, std::size_t component_bytes) {
  const std::size_t begin = nrrd_voxel_offset(path, component_bytes, {"gzip", "gz"});
  VoxelBytes voxels(0, begin == 0 ? 0 : bytes);
  if (begin == 0 || !voxels.fill_from_gzip(bytes_of_file(path, begin))) {
    return std::nullopt;
  }
  return voxels;
}

}  // namespace

VoxelBytes::VoxelBytes(std::size_t header_bytes, std::size_t voxel_bytes)
    : header_bytes_(header_bytes),
      bytes_(header_bytes + voxel_bytes),
      memory_(LargePages<std::uint8_t>().allocate(bytes_), Deleter{bytes_}) {}

bool VoxelBytes::fill_from_gzip(std::span<const std::uint8_t> file) {
  return inflate_gzip(file, {memory_.get(), bytes_});
}

bool VoxelBytes::fill_from_gzip(const fs::path& path) {
  return fill_from_gzip(bytes_of_file(path, 0));
}

std::optional<VoxelBytes> unpack_voxels(const fs::path& path, std::size_t bytes, std::size_t component_bytes,
                                        bool floating) {
  const std::string name = path.filename().string();
  if (name.ends_with(".nii.gz")) {
    return unpack_nifti(path, bytes, component_bytes, floating);
  }
  if (name.ends_with(".nrrd")) {
    return unpack_nrrd(path, bytes, component_bytes);
  }
  return std::nullopt;
}

}  // namespace cbc3d

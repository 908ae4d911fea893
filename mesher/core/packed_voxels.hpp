// Voxels of gzip-compressed NIfTI and NRRD files: reading such a file is mostly its
// decompression, for which inflate.hpp is faster than what ITK uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "mesher/core/large_pages.hpp"

namespace cbc3d {

/// Voxels in memory behind a header.
class VoxelBytes {
 public:
  /// Memory without values.
  VoxelBytes(std::size_t header_bytes, std::size_t voxel_bytes);

  [[nodiscard]] std::uint8_t* data() const { return memory_.get() + header_bytes_; }
  /// Decompresses a file that is the header and the voxels; false when it is anything else.
  [[nodiscard]] bool fill_from_gzip(std::span<const std::uint8_t> file);
  [[nodiscard]] bool fill_from_gzip(const std::filesystem::path& path);

 private:
  std::size_t header_bytes_, bytes_;
  struct Deleter {
    std::size_t bytes;
    void operator()(std::uint8_t* memory) const { LargePages<std::uint8_t>().deallocate(memory, bytes); }
  };
  std::unique_ptr<std::uint8_t[], Deleter> memory_;
};

/// The voxels of a .nii.gz or .nrrd file that holds them itself, gzip-compressed, aligned, in this machine's
/// byte order and not rescaled, `bytes` in all and `component_bytes` each (`floating`: of floats); none for
/// any other file and for a damaged one, which ITK then has to read.
std::optional<VoxelBytes> unpack_voxels(const std::filesystem::path& path, std::size_t bytes,
                                        std::size_t component_bytes, bool floating);

}  // namespace cbc3d

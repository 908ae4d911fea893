// Voxels in memory as their file has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "mesher/core/large_pages.hpp"

namespace cbc3d {

/// Voxels in memory behind a header.
class VoxelBytes {
 public:
  /// Memory without values.
  VoxelBytes(std::size_t header_bytes, std::size_t voxel_bytes)
      : header_bytes_(header_bytes),
        bytes_(header_bytes + voxel_bytes),
        memory_(LargePages<std::uint8_t>().allocate(bytes_), Deleter{bytes_}) {}

  /// The first voxel's first byte.
  [[nodiscard]] std::uint8_t* data() const { return memory_.get() + header_bytes_; }

 private:
  std::size_t header_bytes_, bytes_;
  struct Deleter {
    std::size_t bytes;
    void operator()(std::uint8_t* memory) const { LargePages<std::uint8_t>().deallocate(memory, bytes); }
  };
  std::unique_ptr<std::uint8_t[], Deleter> memory_;
};

}  // namespace cbc3d

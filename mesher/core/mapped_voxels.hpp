// Voxels of an uncompressed file where they lie on the disk, so that no copy of them is in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace cbc3d {

/// A file mapped privately: what is written stays in memory, page by page, and never reaches the file.
/// The system may drop pages that were only read whenever it needs memory.
class MappedVoxels {
 public:
  MappedVoxels(MappedVoxels&& other) noexcept;
  MappedVoxels& operator=(MappedVoxels&& other) noexcept;
  ~MappedVoxels();

  /// The first voxel's first byte.
  [[nodiscard]] void* data() const { return static_cast<char*>(mapping_) + offset_; }
  /// Advises the system to drop the pages that were not written now; they are read again when they are next
  /// accessed.
  void page_out() const;

 private:
  friend std::optional<MappedVoxels> map_voxels(const std::filesystem::path&, std::uint64_t, std::size_t);
  MappedVoxels(void* mapping, std::size_t length, std::size_t offset)
      : mapping_(mapping), length_(length), offset_(offset) {}
  void* mapping_;
  std::size_t length_, offset_;
};

/// Maps a file with `bytes` of voxels from `offset` on; none where it has fewer or the system cannot map it.
std::optional<MappedVoxels> map_voxels(const std::filesystem::path& path, std::uint64_t offset,
                                       std::size_t bytes);

}  // namespace cbc3d

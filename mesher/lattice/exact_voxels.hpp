// The voxels whose own labels a lattice takes, where labels by smoothed shares would change a topology.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/voxel_bits.hpp"

namespace cbc3d {

class ExactVoxels {
 public:
  explicit ExactVoxels(const ImageFrame& frame)
      : frame_(frame), is_exact_(frame.voxel_count()), is_stubborn_(frame.voxel_count()) {}

  /// Adds the voxels of `places`, and the misplaced ones among the 26 around each: an error in topology is
  /// the whole of a tunnel that was filled, not the voxel that could not be filled last. Called again while
  /// the error persists, it follows the tunnel. Both lists ascend.
  void add(const std::vector<std::size_t>& places, const std::vector<std::size_t>& misplaced);

  [[nodiscard]] bool holds(const Vec3& local_mm) const;
  /// True in voxels that were a place again after they were exact: their own labels are not enough there, the
  /// lattice is too coarse.
  [[nodiscard]] bool is_stubborn(const Vec3& local_mm) const;

 private:
  [[nodiscard]] bool test(const VoxelBits& bits, const Vec3& local_mm) const;

  ImageFrame frame_;
  VoxelBits is_exact_;
  VoxelBits is_stubborn_;
};

}  // namespace cbc3d

// Bricks of voxels near which one material is alone, so that nothing need be computed there.
#pragma once

#include <cstdint>

#include "baselines/cleaver/cell_array.hpp"

namespace cbc3d::baselines::cleaver {

class UniformBricks {
 public:
  static constexpr int kBrick = 4;                     ///< voxels along the edge of a brick
  static constexpr std::uint32_t kMixed = 0xFFFFFFFF;  ///< of a brick near which several materials are

  /// `reach_voxels` is how far, along each axis, voxels count for a place.
  UniformBricks(const LabelImage& image, const Vec3& reach_voxels);

  /// The only material within reach of any place in the brick that holds `place` (local mm), or kMixed. Of
  /// places outside the image the nearest brick counts.
  [[nodiscard]] std::uint32_t at(const Vec3& place) const;

  /// True when background is the only material of all bricks in the box from `low` to `high` (local mm).
  [[nodiscard]] bool are_background(const Vec3& low, const Vec3& high) const;

 private:
  [[nodiscard]] Index3 brick_of(const Vec3& place) const;
  void take_own_materials(const LabelImage& image);
  void mix_with_neighbours(std::size_t axis, int around);

  ImageFrame frame_;
  CellArray<std::uint32_t> bricks_;
};

}  // namespace cbc3d::baselines::cleaver

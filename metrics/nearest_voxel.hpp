// The voxel at a place.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesher/core/label_image.hpp"

namespace cbc3d::metrics {

/// The voxel whose centre is nearest to a place in the image's local frame, mm. Of a place off the image it
/// is outside too, at most ten voxels beyond: its indices are small however far the place is.
inline Index3 nearest_voxel(const ImageFrame& frame, const Vec3& local_mm) {
  constexpr double kBeyond = 10;
  Index3 voxel{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = local_mm[axis] / frame.spacing_mm[axis];
    const double last = frame.size[static_cast<std::size_t>(axis)] + kBeyond;
    voxel[static_cast<std::size_t>(axis)] = static_cast<int>(std::lround(std::clamp(index, -kBeyond, last)));
  }
  return voxel;
}

}  // namespace cbc3d::metrics

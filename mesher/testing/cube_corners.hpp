// The corners of n unit cubes along each axis.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::testing {

/// The number of the corner at (i, j, k).
inline VertexId cube_corner(int n, int i, int j, int k) {
  return static_cast<VertexId>(ImageFrame{.size = {n + 1, n + 1, n + 1}}.offset(i, j, k));
}

/// All corners in the order of their numbers.
inline std::vector<Vec3> cube_corners(int n) {
  const ImageFrame grid{.size = {n + 1, n + 1, n + 1}};
  std::vector<Vec3> corners;
  corners.reserve(grid.voxel_count());
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) corners.push_back(grid.local_centre(i, j, k));
    }
  }
  return corners;
}

}  // namespace cbc3d::testing

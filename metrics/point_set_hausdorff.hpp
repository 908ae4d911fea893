// The paper's fidelity: Hausdorff distance between two point sets.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mesher/core/vec3.hpp"

namespace cbc3d::metrics {

/// Both directed distances, mm.
struct PointSetDistance {
  double image_to_mesh_mm;  ///< largest distance of a boundary voxel centre to its nearest surface vertex
  double mesh_to_image_mm;  ///< largest distance of a surface vertex to its nearest boundary voxel centre

  [[nodiscard]] double hausdorff_mm() const { return std::max(image_to_mesh_mm, mesh_to_image_mm); }
};

/// Between the centres of a material's boundary voxels and the vertices on the surface of its sub-mesh,
/// nearest point to nearest point. Nothing when either set is empty. hausdorff_mm is the larger of the two.
/// Boundary voxel centres lie half a voxel inside, so that even a perfect mesh scores about that much.
std::optional<PointSetDistance> point_set_distance(const std::vector<Vec3>& image_points,
                                                   const std::vector<Vec3>& mesh_points);

}  // namespace cbc3d::metrics

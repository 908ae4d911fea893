// Distances between a label's surface in the mesh and its voxel-face surface in the image.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "metrics/image_boundary.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Distances of samples on either surface to the other surface itself (every facet, not its vertices):
///   image to mesh  the centres of the exposed voxel faces to the mesh's triangles;
///   mesh to image  vertices, edge midpoints and triangle centroids of the mesh surface to the exposed voxel
///                  faces.
/// The distance of every sample is exact; the largest over the surfaces can exceed that over the samples by
/// at most the distance between neighbouring samples. Quads count as two triangles.
struct SurfaceDistance {
  double hausdorff_mm;  ///< largest over the samples of both directions
  double hd95_mm;       ///< larger of the two directions' 95th percentiles (nearest rank)
  double sum_mm;        ///< over all samples of both directions
  std::int64_t samples;
};

/// Nothing when either surface is empty. Positions in the image's local frame.
std::optional<SurfaceDistance> surface_distance(const std::vector<VoxelFace>& image_faces,
                                                const ImageFrame& frame, const Surface& surface,
                                                std::uint32_t label_index,
                                                const std::vector<Vec3>& local_points);

}  // namespace cbc3d::metrics

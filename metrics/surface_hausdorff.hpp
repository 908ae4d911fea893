// Distances between a surface of the mesh and the same surface of the image.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "metrics/certified_distance.hpp"
#include "metrics/surface_samples.hpp"

namespace cbc3d::metrics {

/// Distances from the points of one surface to the other surface itself (every facet, not its vertices).
struct DirectedDistance {
  std::int64_t samples = 0;
  double sampled_max_mm = 0;                       ///< largest over the samples
  double sampled_sum_mm = 0, sampled_sum_mm2 = 0;  ///< of the distances and of their squares over the samples
  double sampled_p95_mm = 0;                       ///< 95th percentile of the samples (nearest rank)
  double area_mm2 = 0;                             ///< of the surface that the points are on
  double mean_mm = 0, rms_mm = 0, p95_mm = 0;      ///< every sample by the area it stands for
  std::optional<DistanceBounds> bounds;            ///< of the true supremum, when it was asked for
};

/// Both ways. Samples: see surface_samples.hpp. The distance of every sample is exact; the largest over the
/// surfaces can exceed that over the samples by at most the distance between neighbouring samples.
struct SurfaceDistance {
  DirectedDistance image_to_mesh, mesh_to_image;

  [[nodiscard]] double hausdorff_mm() const;  ///< largest over the samples of both directions
  [[nodiscard]] double hd95_mm() const;       ///< larger of the directions' 95th percentiles of the samples
  /// Bounds of the two-sided Hausdorff distance; nothing where a direction has none.
  [[nodiscard]] std::optional<DistanceBounds> bounds() const;
  /// (integral over both surfaces of the distance) / (area of both); the root of the same of the squares.
  [[nodiscard]] double mean_mm() const;
  [[nodiscard]] double rms_mm() const;
};

/// A surface and the tree of its pieces.
template <class Primitive>
struct SearchableSurface {
  SampledSurface sampled;
  BoxTree<Primitive> tree;
};
SearchableSurface<Triangle> searchable_facets(const Surface& surface,
                                              const std::vector<std::uint32_t>& facets,
                                              const std::vector<Vec3>& points);
SearchableSurface<AlignedBox> searchable_voxel_faces(const std::vector<VoxelFace>& faces,
                                                     const ImageFrame& frame);
SearchableSurface<Triangle> searchable_triangles(const std::vector<SmoothTriangle>& triangles);

/// Nothing when either surface is empty. No bounds without `certify`.
std::optional<SurfaceDistance> surface_distance(const SearchableSurface<AlignedBox>& image,
                                                const SearchableSurface<Triangle>& mesh,
                                                const std::optional<CertifyOptions>& certify);
std::optional<SurfaceDistance> surface_distance(const SearchableSurface<Triangle>& image,
                                                const SearchableSurface<Triangle>& mesh,
                                                const std::optional<CertifyOptions>& certify);

}  // namespace cbc3d::metrics

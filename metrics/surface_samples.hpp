// Samples of surfaces, each with the area it stands for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "metrics/image_boundary.hpp"
#include "metrics/smooth_surface.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// A triangle, or a flat quadrilateral taken as the triangles 0 1 2 and 0 2 3.
struct Polygon {
  std::array<Vec3, 4> p;
  int corners = 3;
};

/// A surface as pieces, and points on it. Point n is the centre of piece n; further points follow.
struct SampledSurface {
  std::vector<Polygon> pieces;
  std::vector<Vec3> points;
  /// Area each point stands for: the sum of weight times value is the integral of the value over the surface,
  /// exact for linear functions at least.
  std::vector<double> weights_mm2;
  double area_mm2 = 0;
};

/// Facets of a mesh (indices into Surface::facets), quads as two triangles. The points are the centroids, the
/// vertices and the midpoints of the edges of the triangles, each once, with the weights 9/20, 1/20 and 2/15
/// of each triangle at them, the rule that is exact for cubics.
SampledSurface sample_facets(const Surface& surface, const std::vector<std::uint32_t>& facets,
                             const std::vector<Vec3>& points);

/// Voxel faces, at their centres.
SampledSurface sample_voxel_faces(const std::vector<VoxelFace>& faces, const ImageFrame& frame);

/// Triangles of a smooth surface, at their centroids.
SampledSurface sample_triangles(const std::vector<SmoothTriangle>& triangles);

}  // namespace cbc3d::metrics

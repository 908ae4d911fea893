// A mesh against a smooth shape that is known exactly.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Signed distance (mm, negative inside, gradient of length 1 near the surface) at a physical LPS position
/// (mm). Called from several threads.
using SignedDistance = std::function<double(const Vec3&)>;

/// A label's surface against the zero level of its signed distance. Integrals are by 19 points on each
/// triangle, so that facets may be large.
struct ShapeDeviation {
  Label label = 0;
  /// Mean over the mesh's surface of the angle between the facet's normal and the shape's, degrees in
  /// [0,180].
  double mean_normal_deviation_deg = 0;
  double max_normal_deviation_deg = 0;
  double mean_distance_mm = 0, max_distance_mm = 0;  ///< absolute, from the mesh's surface to the shape
  double mesh_area_mm2 = 0;
  /// Area of the part of the shape that the mesh's surface lies over: the flux of the shape's normals through
  /// the facets, carried to the shape to first order in distance times curvature.
  double shape_area_mm2 = 0;
  /// 100 (mesh area / shape area - 1): 0 for a perfect surface, 50 for the voxel faces of a large ball. It
  /// has a sign: wrinkles make it positive, while facets with their corners on a convex shape and their
  /// middles below it have a little less area than the shape.
  double area_excess_percent = 0;
};

/// A triangle, counter-clockwise seen from outside the label; physical LPS mm.
using OutwardTriangle = std::array<Vec3, 3>;

/// Those of the surface of the label at an index of MeshView::labels().
std::vector<OutwardTriangle> outward_triangles(const MeshView& view, const Surface& surface,
                                               std::uint32_t label);

/// How a shape is looked at.
struct ShapeSampling {
  double step_mm = 1e-3;  ///< of the finite differences, as below
  double small_mm =
      0;  ///< triangles without a longer edge count by their centroid, distances also at the corners
};

/// Of any triangles; the label is left 0.
ShapeDeviation shape_deviation(const std::vector<OutwardTriangle>& triangles, const SignedDistance& shape,
                               const ShapeSampling& sampling);

/// One entry for each label of `shapes` that the mesh has, ascending. `step_mm`: of the finite differences;
/// small against the radii of curvature, large against rounding.
std::vector<ShapeDeviation> shape_deviations(const MeshView& view, const Surface& surface,
                                             const std::map<Label, SignedDistance>& shapes,
                                             double step_mm = 1e-3);

}  // namespace cbc3d::metrics

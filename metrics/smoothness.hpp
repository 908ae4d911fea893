// How smooth a surface is, in numbers that can be compared between meshes of different size.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "metrics/smooth_surface.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// A flat facet by the numbers and positions of its corners, the fourth kNoCorner for a triangle.
struct NumberedFacet {
  static constexpr std::uint64_t kNoCorner = ~std::uint64_t{0};
  std::array<std::uint64_t, 4> corner;
  std::array<Vec3, 4> at;
};

/// Three or four.
inline std::size_t corner_count(const NumberedFacet& facet) {
  return facet.corner[3] == NumberedFacet::kNoCorner ? 3 : 4;
}

/// Along the normal, as long as the area: half the cross product of two sides of a triangle, of the diagonals
/// of a quad.
inline Vec3 area_vector(const NumberedFacet& facet) {
  const auto& p = facet.at;
  return corner_count(facet) == 3 ? 0.5 * (p[1] - p[0]).cross(p[2] - p[0])
                                  : 0.5 * (p[2] - p[0]).cross(p[3] - p[1]);
}

/// Angles are between the normals of the two facets at an edge (0: flat, 90: the edge of a box), over the
/// edges with exactly two facets, each edge by its length.
struct Smoothness {
  std::int64_t edges = 0;
  double area_mm2 = 0;
  double mean_angle_deg = 0, rms_angle_deg = 0, p95_angle_deg = 0, max_angle_deg = 0;
  /// Half the sum of length times angle (radians), over the area: the mean of the absolute mean curvature,
  /// whatever the size of the facets (Steiner's formula). 1/R on a sphere; on voxel steps it does not shrink
  /// with the mesh.
  double bending_per_mm = 0;
};

/// The facets are consistently oriented. Nothing without an edge of two facets. Time n log n.
std::optional<Smoothness> smoothness(const std::vector<NumberedFacet>& facets);

/// The facets of a label's surface as seen from inside; of a smooth surface.
std::vector<NumberedFacet> numbered_facets(const Surface& surface, std::uint32_t label,
                                           const std::vector<Vec3>& points);
std::vector<NumberedFacet> numbered_facets(const std::vector<SmoothTriangle>& triangles);

/// Keys: facet_angle_mean_deg, facet_angle_rms_deg, facet_angle_p95_deg, facet_angle_max_deg, bending_per_mm,
/// and against the smooth surface of the same label (null without it) smooth_bending_per_mm,
/// bending_ratio (mesh over smooth; 1: as smooth as the segmentation allows) and area_excess_percent
/// (100 (mesh area / smooth area - 1)).
nlohmann::json to_json(const std::optional<Smoothness>& mesh, const std::optional<Smoothness>& smooth);

}  // namespace cbc3d::metrics

// How a surface looks: angles between neighbouring facets, facets that stand off their surroundings, and the
// places where it is sharp, told apart by whether the image itself is thin there.
//
// Notation: normal of a facet   outward from the label (of a quad: of the cross product of its diagonals);
//           normal of a vertex  the normalised sum of the area vectors of the surface's facets at it;
//           angle of an edge    between the normals of its two facets (0: flat, 90: the edge of a box).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Limits above which an edge is counted.
inline constexpr std::array<double, 3> kSharpAnglesDeg{60, 90, 120};
/// A facet further than this from its vertices' normals stands off.
inline constexpr double kOffNormalDeg = 60;
/// How many places are listed.
inline constexpr std::size_t kMostPlaces = 20;

/// Every edge with exactly two facets counts alike, whatever its length. Nothing where there is no edge or no
/// facet.
struct SurfaceShape {
  std::int64_t facets = 0, edges = 0;
  std::optional<double> angle_rms_deg, angle_p95_deg, angle_p99_deg, angle_max_deg;
  std::array<std::int64_t, kSharpAnglesDeg.size()>
      edges_over{};  ///< with a millionth of a degree of tolerance
  /// Facets over kOffNormalDeg off the mean of their corners' vertex normals, and off at least one of these.
  std::int64_t off_normal = 0, off_corner = 0;
  /// Of a triangle 4 sqrt(3) area / sum of squared edges, of a quad the smallest over its corners of
  /// 2 |e1 x e2| / (|e1|^2 + |e2|^2); 1 equilateral or square, 0 flat.
  std::optional<double> mean_ratio_min, mean_ratio_p1, mean_ratio_median;
};

/// Why a surface is sharp at a place. Where the label, or what surrounds it, is at most two voxels thick
/// (is_thin_near), the image asks for it. Elsewhere it is a spike or a pit: the most pointed vertex points
/// outwards or inwards.
enum class PlaceKind : std::uint8_t { kSpike, kPit, kThinLabel, kThinOutside };

/// A run of neighbouring sharp elements: edges over 120 degrees, facets off_normal, and tips, vertices all of
/// whose facets stand over 60 degrees off the vertex normal (a cone of a half angle below 30 degrees).
struct SharpPlace {
  std::uint32_t label = 0;  ///< index into MeshView::labels(), whose surface it is
  PlaceKind kind = PlaceKind::kSpike;
  Vec3 at_mm{};           ///< physical: a tip there, else the middle of the sharpest edge
  double angle_deg = 0;   ///< of that edge
  std::int64_t size = 0;  ///< sharp elements
};

struct SurfaceShapes {
  SurfaceShape outer;                   ///< facets of one cell: all labels as one
  std::vector<SurfaceShape> per_label;  ///< by index into MeshView::labels()
  std::vector<SharpPlace> places;       ///< spikes and pits first, the sharpest first
};

/// Time n log n in the facets.
SurfaceShapes surface_shapes(const MeshView& view, const LabelImage& image, const Surface& surface);

/// The section `surface`. Keys of outer: facets, facet_angle_rms_deg, facet_angle_p95_deg,
/// facet_angle_p99_deg, facet_angle_max_deg, facets_over_60_deg, facets_over_90_deg, facets_over_120_deg
/// (pairs of neighbouring facets), facets_off_normal_60_percent, facets_off_corner_60_percent,
/// facet_mean_ratio ({min, p1, median}); per_label has label, the same, places_asked_by_image and
/// places_not_asked; places has count, asked_by_image, not_asked, spikes, pits, thin_label, thin_outside, and
/// in list at most kMostPlaces of {label, kind, at_mm, angle_deg, elements}.
nlohmann::json to_json(const SurfaceShapes& shapes, const MeshView& view);

}  // namespace cbc3d::metrics

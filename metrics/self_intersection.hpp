// Do the surfaces of a mesh cut, touch or overlap each other where they should not?
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Corners of a triangle.
using Corners = std::array<Vec3, 3>;

/// True when two triangles have a point in common that does not lie in a corner or an edge common to both:
/// they cross, touch (a corner within the other's face or edge) or overlap. Decided exactly for the
/// coordinates as they are. Corners are common when their coordinates are equal; equal triangles are one.
/// False when one of them has no area.
bool triangles_intersect(const Corners& a, const Corners& b);

/// Pairs of facets of a mesh, among all that lie between two labels or between a label and the outside, whose
/// triangles (triangles_of) intersect.
struct SelfIntersections {
  std::int64_t pairs = 0;
  std::vector<std::int64_t>
      per_label;  ///< by label index: pairs of which both facets are of the label's surface
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first;  ///< lowest indices into Surface::facets
  Vec3 first_at_mm;  ///< a place at the first pair, physical: the middle of what their bounding boxes share
};

/// Physical coordinates count, not those in the image's frame, which are rounded. Facets of no area are left
/// out: their cells are flat, and what they cut their neighbours cut. Time n log n beside the pairs whose
/// bounding boxes overlap.
SelfIntersections self_intersections(const MeshView& view, const Surface& surface);

/// Keys for the topology of a mesh, put into `topology`: self_intersections (pairs), the same in every entry
/// of its per_label, and first_self_intersection: null, or facets (the vertices of both), labels (on both
/// sides of each, null for the outside) and at_mm.
void write_json(nlohmann::json& topology, const SelfIntersections& found, const MeshView& view,
                const Surface& surface);

}  // namespace cbc3d::metrics

#include "metrics/self_intersection.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "metrics/box_tree.hpp"
#include "metrics/exact_orientation.hpp"

namespace cbc3d::metrics {
namespace {

// A triangle that has an area, and the plane onto which it is projected with an area.
struct Face {
  Corners corners;
  int axis = 0;  // that is dropped
};

Point2 dropped(const Vec3& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

int flat_orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  return orientation(dropped(a, axis), dropped(b, axis), dropped(c, axis));
}

std::optional<Face> face_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = (b - a).cross(c - a);
  std::array<int, 3> axes{0, 1, 2};
  // Any axis with an area will do; the largest is the one that needs no exact arithmetic.
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int i, int j) { return std::fabs(normal[i]) > std::fabs(normal[j]); });
  for (const int axis : axes) {
    if (flat_orientation(a, b, c, axis) != 0) {
      return Face{corners, axis};
    }
  }
  return std::nullopt;
}

// True when all the points lie beyond the line from a to b, on the side away from c.
bool line_separates(const Vec3& a, const Vec3& b, const Vec3& c, std::span<const Vec3> points, int axis) {
  const int inside = flat_orientation(a, b, c, axis);
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return flat_orientation(a, b, p, axis) == -inside; });
}

// A segment in the plane of a triangle. Convex sets are apart exactly when a line along one of their edges
// keeps them apart.
bool flat_segment_meets(const Vec3& p, const Vec3& q, const Face& face) {
  const std::array<Vec3, 2> segment{p, q};
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3 &a = face.corners[n], &b = face.corners[(n + 1) % 3], &c = face.corners[(n + 2) % 3];
    if (line_separates(a, b, c, segment, face.axis)) {
      return false;
    }
  }
  const auto side = [&](std::size_t n) { return flat_orientation(p, q, face.corners[n], face.axis); };
  return side(0) == 0 || side(0) != side(1) || side(0) != side(2);
}

// Sides of the plane of a face on which the corners of another lie.
using Sides = std::array<int, 3>;

Sides sides_of(const Face& face, const Corners& points) {
  const auto& [a, b, c] = face.corners;
  return {orientation(a, b, c, points[0]), orientation(a, b, c, points[1]), orientation(a, b, c, points[2])};
}

bool all_on_one_side(const Sides& sides) {
  return sides[0] != 0 && sides[0] == sides[1] && sides[0] == sides[2];
}

// The segment from p to q, which lie on these sides of the face's plane.
bool segment_meets(const Vec3& p, int side_p, const Vec3& q, int side_q, const Face& face) {
  if (side_p * side_q > 0) {
    return false;
  }
  if (side_p == 0 && side_q == 0) {
    return flat_segment_meets(p, q, face);
  }
  bool left = false, right = false;
  for (std::size_t n = 0; n < 3; ++n) {
    const int side = orientation(p, q, face.corners[n], face.corners[(n + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !left || !right;
}

bool edge_meets(const Face& of, std::size_t from, std::size_t to, const Sides& sides, const Face& face) {
  return segment_meets(of.corners[from], sides[from], of.corners[to], sides[to], face);
}

// Nothing in common: they meet where an edge of one meets the other.
bool separate_faces_meet(const Face& a, const Face& b) {
  const Sides of_b = sides_of(a, b.corners);
  if (all_on_one_side(of_b)) {
    return false;
  }
  const Sides of_a = sides_of(b, a.corners);
  if (all_on_one_side(of_a)) {
    return false;
  }
  for (std::size_t n = 0; n < 3; ++n) {
    if (edge_meets(a, n, (n + 1) % 3, of_a, b) || edge_meets(b, n, (n + 1) % 3, of_b, a)) {
      return true;
    }
  }
  return false;
}

// With common corners a[i] and b[j]. What else they share reaches, away from that corner, the edge opposite
// to it in one of them.
bool faces_at_corner_meet(const Face& a, std::size_t i, const Face& b, std::size_t j) {
  const auto opposite_meets = [](const Face& of, std::size_t corner, const Face& face) {
    const Vec3 &p = of.corners[(corner + 1) % 3], &q = of.corners[(corner + 2) % 3];
    const auto& [x, y, z] = face.corners;
    return segment_meets(p, orientation(x, y, z, p), q, orientation(x, y, z, q), face);
  };
  return opposite_meets(a, i, b) || opposite_meets(b, j, a);
}

// With a common edge, whose opposite corners are a[i] and b[j]: only in one plane, on one side of the edge.
bool faces_at_edge_meet(const Face& a, std::size_t i, const Face& b, std::size_t j) {
  const auto& [x, y, z] = a.corners;
  if (orientation(x, y, z, b.corners[j]) != 0) {
    return false;
  }
  const Vec3 &p = a.corners[(i + 1) % 3], &q = a.corners[(i + 2) % 3];
  return flat_orientation(p, q, a.corners[i], a.axis) == flat_orientation(p, q, b.corners[j], a.axis);
}

bool faces_meet(const Face& a, const Face& b) {
  std::array<bool, 3> shared_a{}, shared_b{};
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.corners[i] == b.corners[j]) {
        shared_a[i] = shared_b[j] = true;
        ++shared;
      }
    }
  }
  const auto first = [](const std::array<bool, 3>& flags, bool value) {
    return static_cast<std::size_t>(std::find(flags.begin(), flags.end(), value) - flags.begin());
  };
  switch (shared) {
    case 0:
      return separate_faces_meet(a, b);
    case 1:
      return faces_at_corner_meet(a, first(shared_a, true), b, first(shared_b, true));
    case 2:
      return faces_at_edge_meet(a, first(shared_a, false), b, first(shared_b, false));
    default:
      return false;
  }
}

// A facet of the mesh in the tree.
struct FacetFaces {
  std::uint32_t facet;
  std::uint8_t count = 0;
  std::array<Face, 2> faces;
  Box box;

  void add_to(Box& to) const {
    to.add(box.low);
    to.add(box.high);
  }
};

std::vector<FacetFaces> faces_of(const MeshView& view, const Surface& surface) {
  const std::vector<Vec3>& points = view.mesh().points;
  std::vector<FacetFaces> result;
  result.reserve(surface.facets.size());
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    FacetFaces one{f, 0, {}, {}};
    const FacetTriangles split = triangles_of(surface.facets[f]);
    for (int t = 0; t < split.count; ++t) {
      const auto& [a, b, c] = split.triangles[static_cast<std::size_t>(t)];
      if (const auto face = face_of({points[a], points[b], points[c]})) {
        one.faces[one.count++] = *face;
        std::for_each(face->corners.begin(), face->corners.end(), [&](const Vec3& p) { one.box.add(p); });
      }
    }
    if (one.count > 0) {
      result.push_back(one);
    }
  }
  return result;
}

bool facets_meet(const FacetFaces& a, const FacetFaces& b) {
  for (std::uint8_t i = 0; i < a.count; ++i) {
    for (std::uint8_t j = 0; j < b.count; ++j) {
      if (faces_meet(a.faces[i], b.faces[j])) {
        return true;
      }
    }
  }
  return false;
}

bool is_of_label(const SurfaceFacet& facet, std::uint32_t label) {
  return facet.inside == label || facet.outside == label;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// What one thread has found.
struct Found {
  std::int64_t pairs = 0;
  std::vector<std::int64_t> per_label;
  std::optional<Pair> first;
  Vec3 at;

  void add(const FacetFaces& a, const FacetFaces& b, const Surface& surface) {
    const Pair pair = std::minmax(a.facet, b.facet);
    ++pairs;
    const SurfaceFacet& one = surface.facets[a.facet];
    for (const std::uint32_t label : {one.inside, one.outside}) {
      if (label != kOutside && is_of_label(surface.facets[b.facet], label)) {
        ++per_label[label];
      }
    }
    if (!first || pair < *first) {
      first = pair;
      for (int axis = 0; axis < 3; ++axis) {
        at[axis] =
            0.5 * (std::max(a.box.low[axis], b.box.low[axis]) + std::min(a.box.high[axis], b.box.high[axis]));
      }
    }
  }
  void add_to(SelfIntersections& total) const {
    total.pairs += pairs;
    for (std::size_t l = 0; l < per_label.size(); ++l) {
      total.per_label[l] += per_label[l];
    }
    if (first && (!total.first || *first < *total.first)) {
      total.first = first;
      total.first_at_mm = at;
    }
  }
};

}  // namespace

bool triangles_intersect(const Corners& a, const Corners& b) {
  const auto first = face_of(a), second = face_of(b);
  return first && second && faces_meet(*first, *second);
}

SelfIntersections self_intersections(const MeshView& view, const Surface& surface) {
  SelfIntersections total;
  total.per_label.resize(view.labels().size());
  const BoxTree<FacetFaces> tree(faces_of(view, surface));
#pragma omp parallel
  {
    Found mine;
    mine.per_label.resize(total.per_label.size());
    // Each pair once, from the lower of its places in the tree; integers and a least pair know no order.
#pragma omp for schedule(dynamic, 512)
    for (std::size_t n = 0; n < tree.size(); ++n) {
      const FacetFaces& one = tree.primitive(n);
      tree.for_each_overlapping(one.box, n + 1, [&](const FacetFaces& other) {
        if (facets_meet(one, other)) {
          mine.add(one, other, surface);
        }
      });
    }
#pragma omp critical
    mine.add_to(total);
  }
  return total;
}

namespace {

using nlohmann::json;

json first_json(const SelfIntersections& found, const MeshView& view, const Surface& surface) {
  if (!found.first) {
    return nullptr;
  }
  json object{{"facets", json::array()}, {"labels", json::array()}};
  for (const std::uint32_t f : {found.first->first, found.first->second}) {
    const SurfaceFacet& facet = surface.facets[f];
    const auto begin = facet.nodes.begin();
    object["facets"].push_back(
        std::vector<VertexId>(begin, begin + static_cast<std::ptrdiff_t>(facet.corners())));
    const auto label = [&](std::uint32_t index) {
      return index == kOutside ? json(nullptr) : json(view.labels()[index]);
    };
    object["labels"].push_back({label(facet.inside), label(facet.outside)});
  }
  object["at_mm"] = {found.first_at_mm.x, found.first_at_mm.y, found.first_at_mm.z};
  return object;
}

}  // namespace

void write_json(json& topology, const SelfIntersections& found, const MeshView& view,
                const Surface& surface) {
  topology["self_intersections"] = found.pairs;
  topology["first_self_intersection"] = first_json(found, view, surface);
  json& rows = topology["per_label"];
  for (std::size_t l = 0; l < rows.size(); ++l) {
    rows[l]["self_intersections"] = found.per_label[l];
  }
}

}  // namespace cbc3d::metrics

#include "metrics/hanging_vertices.hpp"

#include <algorithm>

#include "metrics/box_tree.hpp"

namespace cbc3d::metrics {
namespace {

struct OuterTriangle : Triangle {
  std::array<VertexId, 4> facet;  // the vertices of the facet it is part of

  [[nodiscard]] bool has(VertexId v) const { return std::find(facet.begin(), facet.end(), v) != facet.end(); }
};

}  // namespace

CountedFault count_hanging_vertices(const MeshView& view, const Surface& surface) {
  constexpr double kRelativeTolerance = 1e-9;
  const std::vector<Vec3>& points = view.local_points();
  std::vector<OuterTriangle> triangles;
  std::vector<VertexId> vertices;
  Box extent;
  for (const SurfaceFacet& facet : surface.facets) {
    // Where cells do not fit, the facets of both sides are left alone and so face the outside.
    if (facet.outside != kOutside) {
      continue;
    }
    const FacetTriangles split = triangles_of(facet);
    for (int t = 0; t < split.count; ++t) {
      const auto& [a, b, c] = split.triangles[static_cast<std::size_t>(t)];
      triangles.push_back({{points[a], points[b], points[c]}, facet.nodes});
      triangles.back().add_to(extent);
    }
    vertices.insert(vertices.end(), facet.nodes.begin(),
                    facet.nodes.begin() + static_cast<std::ptrdiff_t>(facet.corners()));
  }
  if (triangles.empty()) {
    return {};
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const double squared_tolerance =
      kRelativeTolerance * kRelativeTolerance * (extent.high - extent.low).squared_norm();
  const BoxTree<OuterTriangle> tree(std::move(triangles));
  std::int64_t hanging = 0;
  std::size_t first = vertices.size();
#pragma omp parallel for reduction(+ : hanging) reduction(min : first) schedule(dynamic, 1024)
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    const VertexId v = vertices[n];
    const bool hangs = tree.any_within(points[v], squared_tolerance,
                                       [v](const OuterTriangle& triangle) { return !triangle.has(v); });
    hanging += hangs ? 1 : 0;
    first = hangs ? std::min(first, n) : first;
  }
  return {hanging, hanging > 0 ? vertices[first] : 0};
}

}  // namespace cbc3d::metrics

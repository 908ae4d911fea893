#include "metrics/surface_samples.hpp"

#include <algorithm>
#include <utility>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

using IndexTriangle = std::array<VertexId, 3>;

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

std::vector<IndexTriangle> triangles_of_facets(const Surface& surface,
                                               const std::vector<std::uint32_t>& facets) {
  std::vector<IndexTriangle> triangles;
  triangles.reserve(facets.size());
  for (const std::uint32_t f : facets) {
    const FacetTriangles split = triangles_of(surface.facets[f]);
    for (int t = 0; t < split.count; ++t) {
      triangles.push_back(split.triangles[static_cast<std::size_t>(t)]);
    }
  }
  return triangles;
}

// Simplices of the triangles (vertices or edges), each once, with its share of the area of the triangles at
// it.
template <class Key>
struct Weighted {
  Key key;
  double area;
};

template <class Key>
void merge_equal(std::vector<Weighted<Key>>& all) {
  // Stable, so that the areas are added in the order of the triangles.
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (kept > 0 && all[kept - 1].key == all[n].key) {
      all[kept - 1].area += all[n].area;
    } else {
      all[kept++] = all[n];
    }
  }
  all.resize(kept);
}

}  // namespace

SampledSurface sample_facets(const Surface& surface, const std::vector<std::uint32_t>& facets,
                             const std::vector<Vec3>& points) {
  using Edge = std::pair<VertexId, VertexId>;
  SampledSurface sampled;
  std::vector<Weighted<VertexId>> vertices;
  std::vector<Weighted<Edge>> edges;
  for (const IndexTriangle& t : triangles_of_facets(surface, facets)) {
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const double area = area_of(a, b, c);
    sampled.pieces.push_back({{a, b, c, c}, 3});
    sampled.points.push_back((a + b + c) / 3);
    sampled.weights_mm2.push_back(area * 9 / 20);
    sampled.area_mm2 += area;
    for (std::size_t n = 0; n < 3; ++n) {
      vertices.push_back({t[n], area});
      edges.push_back({std::minmax(t[n], t[(n + 1) % 3]), area});
    }
  }
  merge_equal(vertices);
  merge_equal(edges);
  for (const auto& [v, area] : vertices) {
    sampled.points.push_back(points[v]);
    sampled.weights_mm2.push_back(area / 20);
  }
  for (const auto& [edge, area] : edges) {
    sampled.points.push_back(0.5 * (points[edge.first] + points[edge.second]));
    sampled.weights_mm2.push_back(area * 2 / 15);
  }
  return sampled;
}

SampledSurface sample_voxel_faces(const std::vector<VoxelFace>& faces, const ImageFrame& frame) {
  const Vec3 areas = voxel_face_areas_mm2(frame);
  SampledSurface sampled;
  sampled.pieces.resize(faces.size());
  sampled.points.resize(faces.size());
  sampled.weights_mm2.resize(faces.size());
#pragma omp parallel for if (faces.size() > kWorthThreads)
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Box box = box_of(faces[f], frame);
    const int u = (faces[f].axis + 1) % 3;
    Vec3 b = box.low, d = box.high;
    b[u] = box.high[u];
    d[u] = box.low[u];
    sampled.pieces[f] = {{box.low, b, box.high, d}, 4};
    sampled.points[f] = centre_of(faces[f], frame);
    sampled.weights_mm2[f] = areas[faces[f].axis];
  }
  for (const double area : sampled.weights_mm2) {
    sampled.area_mm2 += area;
  }
  return sampled;
}

SampledSurface sample_triangles(const std::vector<SmoothTriangle>& triangles) {
  SampledSurface sampled;
  for (const SmoothTriangle& one : triangles) {
    const auto& [a, b, c] = one.triangle;
    sampled.pieces.push_back({{a, b, c, c}, 3});
    sampled.points.push_back((a + b + c) / 3);
    sampled.weights_mm2.push_back(area_of(a, b, c));
    sampled.area_mm2 += sampled.weights_mm2.back();
  }
  return sampled;
}

}  // namespace cbc3d::metrics

#include "metrics/surface_hausdorff.hpp"

#include <algorithm>
#include <cmath>

#include "metrics/box_tree.hpp"
#include "metrics/reduce.hpp"

namespace cbc3d::metrics {

double Triangle::squared_distance(const Vec3& p) const {
  // Inside the prism over the triangle the plane is nearest, elsewhere an edge.
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d00 = ab.dot(ab), d01 = ab.dot(ac), d11 = ac.dot(ac);
  const double d20 = ap.dot(ab), d21 = ap.dot(ac);
  const double area = d00 * d11 - d01 * d01;
  const double v = d11 * d20 - d01 * d21, w = d00 * d21 - d01 * d20;
  if (area > 0 && v >= 0 && w >= 0 && v + w <= area) {
    const Vec3 normal = ab.cross(ac);
    const double height = ap.dot(normal);
    return height * height / normal.squared_norm();
  }
  const auto to_edge = [&p](const Vec3& from, const Vec3& to) {
    const Vec3 edge = to - from, q = p - from;
    const double length2 = edge.squared_norm();
    const double t = length2 > 0 ? std::clamp(q.dot(edge) / length2, 0.0, 1.0) : 0.0;
    return (q - t * edge).squared_norm();
  };
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

namespace {

std::vector<Triangle> triangles_of_label(const Surface& surface, std::uint32_t label,
                                         const std::vector<Vec3>& points) {
  std::vector<Triangle> triangles;
  triangles.reserve(surface.facets_of[label].size());
  for (const std::uint32_t f : surface.facets_of[label]) {
    const FacetTriangles split = triangles_of(surface.facets[f]);
    for (int t = 0; t < split.count; ++t) {
      const auto& [a, b, c] = split.triangles[static_cast<std::size_t>(t)];
      triangles.push_back({points[a], points[b], points[c]});
    }
  }
  return triangles;
}

// Vertices, then facet by facet midpoints of edges and centroids of triangles. An edge is taken at the facet
// that runs it upwards; the other facet at it runs it downwards.
std::vector<Vec3> samples_of_label(const Surface& surface, std::uint32_t label,
                                   const std::vector<Vec3>& points) {
  std::vector<Vec3> samples;
  for (const std::uint32_t f : surface.facets_of[label]) {
    const SurfaceFacet& facet = surface.facets[f];
    const bool outward = facet.inside == label;
    for (std::size_t n = 0; n < facet.corners(); ++n) {
      const VertexId from = facet.nodes[n], to = facet.nodes[(n + 1) % facet.corners()];
      if ((from < to) == outward) {
        samples.push_back(0.5 * (points[from] + points[to]));
      }
    }
    const FacetTriangles split = triangles_of(facet);
    for (int t = 0; t < split.count; ++t) {
      const auto& [a, b, c] = split.triangles[static_cast<std::size_t>(t)];
      samples.push_back((points[a] + points[b] + points[c]) / 3);
    }
  }
  for (const VertexId v : surface.vertices_of[label]) {
    samples.push_back(points[v]);
  }
  return samples;
}

AlignedBox box_of(const VoxelFace& face, const ImageFrame& frame) {
  const Vec3 centre = centre_of(face, frame);
  Vec3 half = 0.5 * frame.spacing_mm;
  half[face.axis] = 0;
  return {{centre - half, centre + half}};
}

template <class Primitive>
std::vector<double> distances(const std::vector<Vec3>& samples, const BoxTree<Primitive>& tree) {
  std::vector<double> result(samples.size());
#pragma omp parallel
  {
    std::size_t hint = 0;  // neighbouring samples have neighbouring nearest primitives
#pragma omp for schedule(static)
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const auto nearest = tree.nearest(samples[s], hint);
      hint = nearest.index;
      result[s] = std::sqrt(nearest.squared);
    }
  }
  return result;
}

double sum_of(const std::vector<double>& values) {
  return ordered_sums<double>(values.size(), 1,
                              [&](std::size_t i, std::vector<double>& sum) { sum[0] += values[i]; })[0];
}

// Smallest value that at least 95 % of the values do not exceed; reorders them.
double percentile95(std::vector<double>& values) {
  const auto rank = static_cast<std::ptrdiff_t>((values.size() * 95 + 99) / 100) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

std::optional<SurfaceDistance> surface_distance(const std::vector<VoxelFace>& image_faces,
                                                const ImageFrame& frame, const Surface& surface,
                                                std::uint32_t label_index,
                                                const std::vector<Vec3>& local_points) {
  if (image_faces.empty() || surface.facets_of[label_index].empty()) {
    return std::nullopt;
  }
  std::vector<Vec3> image_samples(image_faces.size());
  std::vector<AlignedBox> boxes(image_faces.size());
#pragma omp parallel for
  for (std::size_t f = 0; f < image_faces.size(); ++f) {
    image_samples[f] = centre_of(image_faces[f], frame);
    boxes[f] = box_of(image_faces[f], frame);
  }
  const BoxTree<Triangle> mesh_tree(triangles_of_label(surface, label_index, local_points));
  std::vector<double> to_mesh = distances(image_samples, mesh_tree);
  const BoxTree<AlignedBox> image_tree(std::move(boxes));
  std::vector<double> to_image = distances(samples_of_label(surface, label_index, local_points), image_tree);

  SurfaceDistance result{};
  result.sum_mm = sum_of(to_mesh) + sum_of(to_image);
  result.samples = static_cast<std::int64_t>(to_mesh.size() + to_image.size());
  result.hausdorff_mm = std::max(*std::max_element(to_mesh.begin(), to_mesh.end()),
                                 *std::max_element(to_image.begin(), to_image.end()));
  result.hd95_mm = std::max(percentile95(to_mesh), percentile95(to_image));
  return result;
}

}  // namespace cbc3d::metrics

#include "metrics/surface_hausdorff.hpp"

#include <algorithm>
#include <cmath>

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

template <class Primitive>
using NearestList = std::vector<typename BoxTree<Primitive>::Nearest>;

template <class Primitive>
NearestList<Primitive> find_nearest(const std::vector<Vec3>& points, const BoxTree<Primitive>& tree) {
  NearestList<Primitive> result(points.size());
#pragma omp parallel if (points.size() > kWorthThreads)
  {
    std::size_t hint = 0;  // neighbouring samples have neighbouring nearest primitives
#pragma omp for schedule(static)
    for (std::size_t s = 0; s < points.size(); ++s) {
      result[s] = tree.nearest(points[s], hint);
      hint = result[s].index;
    }
  }
  return result;
}

struct WeightedDistance {
  double distance, weight;
};

// Smallest distance that at least 95 % of the samples do not exceed; reorders them.
double percentile95(std::vector<WeightedDistance>& samples) {
  const auto rank = static_cast<std::ptrdiff_t>((samples.size() * 95 + 99) / 100) - 1;
  std::nth_element(samples.begin(), samples.begin() + rank, samples.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return samples[static_cast<std::size_t>(rank)].distance;
}

// Smallest distance that 95 % of the area does not exceed, by halving as for a median; reorders the samples.
double weighted_percentile95(std::vector<WeightedDistance>& samples, double total) {
  std::size_t begin = 0, end = samples.size();
  double below = 0;
  while (end - begin > 1) {
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t n) { return samples.begin() + static_cast<std::ptrdiff_t>(n); };
    std::nth_element(at(begin), at(middle), at(end),
                     [](const auto& a, const auto& b) { return a.distance < b.distance; });
    double lower_half = 0;
    for (std::size_t n = begin; n < middle; ++n) {
      lower_half += samples[n].weight;
    }
    if (below + lower_half >= 0.95 * total) {
      end = middle;
    } else {
      below += lower_half;
      begin = middle;
    }
  }
  return samples[begin].distance;
}

template <class Primitive>
DirectedDistance directed_distance(const SampledSurface& from, const BoxTree<Primitive>& tree,
                                   const std::optional<CertifyOptions>& certify) {
  const NearestList<Primitive> nearest = find_nearest(from.points, tree);
  std::vector<WeightedDistance> samples(nearest.size());
#pragma omp parallel for if (samples.size() > kWorthThreads)
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n] = {std::sqrt(nearest[n].squared), from.weights_mm2[n]};
  }
  enum Sum { kDistance, kSquare, kWeight, kWeighted, kWeightedSquare, kSums };
  const auto sums = ordered_sums<double>(samples.size(), kSums, [&](std::size_t n, std::vector<double>& sum) {
    const auto& [distance, weight] = samples[n];
    sum[kDistance] += distance;
    sum[kSquare] += distance * distance;
    sum[kWeight] += weight;
    sum[kWeighted] += weight * distance;
    sum[kWeightedSquare] += weight * distance * distance;
  });
  DirectedDistance result;
  result.samples = static_cast<std::int64_t>(samples.size());
  result.sampled_sum_mm = sums[kDistance];
  result.sampled_sum_mm2 = sums[kSquare];
  result.area_mm2 = from.area_mm2;
  result.mean_mm = sums[kWeight] > 0 ? sums[kWeighted] / sums[kWeight] : 0;
  result.rms_mm = sums[kWeight] > 0 ? std::sqrt(sums[kWeightedSquare] / sums[kWeight]) : 0;
  result.sampled_p95_mm = percentile95(samples);
  result.p95_mm = weighted_percentile95(samples, sums[kWeight]);
  for (const auto& sample : samples) {
    result.sampled_max_mm = std::max(result.sampled_max_mm, sample.distance);
  }
  if (certify) {
    result.bounds = certified_distance(from, tree, nearest, *certify);
  }
  return result;
}

template <class Image>
std::optional<SurfaceDistance> both_ways(const Image& image, const SearchableSurface<Triangle>& mesh,
                                         const std::optional<CertifyOptions>& certify) {
  if (image.sampled.pieces.empty() || mesh.sampled.pieces.empty()) {
    return std::nullopt;
  }
  return SurfaceDistance{directed_distance(image.sampled, mesh.tree, certify),
                         directed_distance(mesh.sampled, image.tree, certify)};
}

std::vector<Triangle> triangles_of_pieces(const SampledSurface& sampled) {
  std::vector<Triangle> triangles(sampled.pieces.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const auto& p = sampled.pieces[n].p;
    triangles[n] = {p[0], p[1], p[2]};
  }
  return triangles;
}

SearchableSurface<Triangle> searchable(SampledSurface sampled) {
  BoxTree<Triangle> tree(triangles_of_pieces(sampled));
  return {std::move(sampled), std::move(tree)};
}

}  // namespace

double SurfaceDistance::hausdorff_mm() const {
  return std::max(image_to_mesh.sampled_max_mm, mesh_to_image.sampled_max_mm);
}

double SurfaceDistance::hd95_mm() const {
  return std::max(image_to_mesh.sampled_p95_mm, mesh_to_image.sampled_p95_mm);
}

std::optional<DistanceBounds> SurfaceDistance::bounds() const {
  const auto &a = image_to_mesh.bounds, &b = mesh_to_image.bounds;
  if (!a || !b) {
    return std::nullopt;
  }
  return DistanceBounds{std::max(a->lower_mm, b->lower_mm), std::max(a->upper_mm, b->upper_mm)};
}

double SurfaceDistance::mean_mm() const {
  const DirectedDistance &a = image_to_mesh, &b = mesh_to_image;
  return (a.area_mm2 * a.mean_mm + b.area_mm2 * b.mean_mm) / (a.area_mm2 + b.area_mm2);
}

double SurfaceDistance::rms_mm() const {
  const DirectedDistance &a = image_to_mesh, &b = mesh_to_image;
  return std::sqrt((a.area_mm2 * a.rms_mm * a.rms_mm + b.area_mm2 * b.rms_mm * b.rms_mm) /
                   (a.area_mm2 + b.area_mm2));
}

SearchableSurface<Triangle> searchable_facets(const Surface& surface,
                                              const std::vector<std::uint32_t>& facets,
                                              const std::vector<Vec3>& points) {
  return searchable(sample_facets(surface, facets, points));
}

SearchableSurface<AlignedBox> searchable_voxel_faces(const std::vector<VoxelFace>& faces,
                                                     const ImageFrame& frame) {
  std::vector<AlignedBox> boxes(faces.size());
#pragma omp parallel for if (faces.size() > kWorthThreads)
  for (std::size_t f = 0; f < faces.size(); ++f) {
    boxes[f] = {box_of(faces[f], frame)};
  }
  return {sample_voxel_faces(faces, frame), BoxTree<AlignedBox>(std::move(boxes))};
}

SearchableSurface<Triangle> searchable_triangles(const std::vector<SmoothTriangle>& triangles) {
  return searchable(sample_triangles(triangles));
}

std::optional<SurfaceDistance> surface_distance(const SearchableSurface<AlignedBox>& image,
                                                const SearchableSurface<Triangle>& mesh,
                                                const std::optional<CertifyOptions>& certify) {
  return both_ways(image, mesh, certify);
}

std::optional<SurfaceDistance> surface_distance(const SearchableSurface<Triangle>& image,
                                                const SearchableSurface<Triangle>& mesh,
                                                const std::optional<CertifyOptions>& certify) {
  return both_ways(image, mesh, certify);
}

}  // namespace cbc3d::metrics

#include "metrics/shape_deviation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

struct WeightedPoint {
  std::array<double, 3> barycentric;
  double weight;
};

// The seven-point rule, exact for cubics, on each of the four triangles between the corners and the middles
// of the sides. On the whole triangle it would give too little for the angle, which over a facet on a smooth
// surface is a cone with its tip at the centroid, where that rule has its largest weight: a quarter on a
// sphere.
constexpr double kCorner = 1.0 / 80, kMiddle = 3.0 / 80, kQuarter = 1.0 / 30, kInner = 1.0 / 15,
                 kCentroid = 9.0 / 80;
constexpr double kThird = 1.0 / 3, kSixth = 1.0 / 6;
constexpr std::array<WeightedPoint, 19> kRule{{{{1, 0, 0}, kCorner},
                                               {{0, 1, 0}, kCorner},
                                               {{0, 0, 1}, kCorner},
                                               {{.5, .5, 0}, kMiddle},
                                               {{0, .5, .5}, kMiddle},
                                               {{.5, 0, .5}, kMiddle},
                                               {{.75, .25, 0}, kQuarter},
                                               {{.25, .75, 0}, kQuarter},
                                               {{0, .75, .25}, kQuarter},
                                               {{0, .25, .75}, kQuarter},
                                               {{.75, 0, .25}, kQuarter},
                                               {{.25, 0, .75}, kQuarter},
                                               {{.5, .25, .25}, kInner},
                                               {{.25, .5, .25}, kInner},
                                               {{.25, .25, .5}, kInner},
                                               {{kThird, kThird, kThird}, kCentroid},
                                               {{2 * kThird, kSixth, kSixth}, kCentroid},
                                               {{kSixth, 2 * kThird, kSixth}, kCentroid},
                                               {{kSixth, kSixth, 2 * kThird}, kCentroid}}};

// A shape near a point.
struct ShapeAt {
  double distance;
  Vec3 normal;
  double laplacian;  // sum of the principal curvatures
};

ShapeAt shape_at(const SignedDistance& shape, const Vec3& p, double step) {
  const double here = shape(p);
  ShapeAt result{here, {}, 0};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 by{};
    by[axis] = step;
    const double ahead = shape(p + by), behind = shape(p - by);
    result.normal[axis] = (ahead - behind) / (2 * step);
    result.laplacian += (ahead - 2 * here + behind) / (step * step);
  }
  result.normal = result.normal.normalized();
  return result;
}

}  // namespace

std::vector<OutwardTriangle> outward_triangles(const MeshView& view, const Surface& surface,
                                               std::uint32_t label) {
  const std::vector<Vec3>& points = view.mesh().points;
  std::vector<OutwardTriangle> result;
  for (const std::uint32_t f : surface.facets_of[label]) {
    const FacetTriangles split = triangles_of(surface.facets[f]);
    for (int t = 0; t < split.count; ++t) {
      const auto& [a, b, c] = split.triangles[static_cast<std::size_t>(t)];
      const bool outward = surface.facets[f].inside == label;
      result.push_back({{points[a], points[outward ? b : c], points[outward ? c : b]}});
    }
  }
  return result;
}

namespace {

enum Sum { kArea, kShapeArea, kAngle, kDistance, kSums };

struct Largest {
  double angle = 0, distance = 0;
};

// What is added at a point that stands for `area` of a triangle with this unit normal.
void add_point(const ShapeAt& there, const Vec3& normal, double area, std::vector<double>& sums,
               Largest& largest) {
  const double cosine = normal.dot(there.normal);
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  const double distance = std::fabs(there.distance);
  sums[kShapeArea] += area * cosine * (1 - there.distance * there.laplacian);
  sums[kAngle] += area * angle;
  sums[kDistance] += area * distance;
  largest.angle = std::max(largest.angle, angle);
  largest.distance = std::max(largest.distance, distance);
}

void add_triangle(const OutwardTriangle& triangle, const SignedDistance& shape, const ShapeSampling& sampling,
                  std::vector<double>& sums, Largest& largest) {
  const auto& [a, b, c] = triangle;
  const Vec3 area_vector = 0.5 * (b - a).cross(c - a);
  const double area = area_vector.norm();
  if (!(area > 0)) {
    return;
  }
  sums[kArea] += area;
  const Vec3 normal = area_vector / area;
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (longest <= sampling.small_mm) {
    add_point(shape_at(shape, (a + b + c) / 3, sampling.step_mm), normal, area, sums, largest);
    for (const Vec3& corner : triangle) {
      largest.distance = std::max(largest.distance, std::fabs(shape(corner)));
    }
    return;
  }
  for (const auto& [at, weight] : kRule) {
    const Vec3 p = at[0] * a + at[1] * b + at[2] * c;
    add_point(shape_at(shape, p, sampling.step_mm), normal, weight * area, sums, largest);
  }
}

}  // namespace

ShapeDeviation shape_deviation(const std::vector<OutwardTriangle>& triangles, const SignedDistance& shape,
                               const ShapeSampling& sampling) {
  std::vector<Largest> largest(triangles.size());
  const auto sums =
      ordered_sums<double>(triangles.size(), kSums, [&](std::size_t t, std::vector<double>& sum) {
        add_triangle(triangles[t], shape, sampling, sum, largest[t]);
      });
  ShapeDeviation result;
  result.mesh_area_mm2 = sums[kArea];
  result.shape_area_mm2 = sums[kShapeArea];
  if (sums[kArea] > 0) {
    result.mean_normal_deviation_deg = sums[kAngle] / sums[kArea];
    result.mean_distance_mm = sums[kDistance] / sums[kArea];
  }
  if (sums[kShapeArea] > 0) {
    result.area_excess_percent = 100 * (sums[kArea] / sums[kShapeArea] - 1);
  }
  for (const auto& [angle, distance] : largest) {
    result.max_normal_deviation_deg = std::max(result.max_normal_deviation_deg, angle);
    result.max_distance_mm = std::max(result.max_distance_mm, distance);
  }
  return result;
}

std::vector<ShapeDeviation> shape_deviations(const MeshView& view, const Surface& surface,
                                             const std::map<Label, SignedDistance>& shapes, double step_mm) {
  std::vector<ShapeDeviation> result;
  for (const auto& [label, shape] : shapes) {
    if (const auto index = view.find_label(label)) {
      result.push_back(shape_deviation(outward_triangles(view, surface, *index), shape, {step_mm, 0}));
      result.back().label = label;
    }
  }
  return result;
}

}  // namespace cbc3d::metrics

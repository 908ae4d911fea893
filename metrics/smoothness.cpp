#include "metrics/smoothness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

struct FacetEdge {
  std::uint64_t low, high;
  std::uint32_t facet;
  bool upwards;
  double length_mm;
};

struct EdgeAngle {
  double angle, length;
};

std::vector<FacetEdge> sorted_edges(const std::vector<NumberedFacet>& facets) {
  std::vector<FacetEdge> edges;
  edges.reserve(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const NumberedFacet& facet = facets[f];
    const std::size_t corners = corner_count(facet);
    for (std::size_t n = 0; n < corners; ++n) {
      const std::size_t next = (n + 1) % corners;
      const auto [low, high] = std::minmax(facet.corner[n], facet.corner[next]);
      edges.push_back({low, high, static_cast<std::uint32_t>(f), facet.corner[n] < facet.corner[next],
                       (facet.at[next] - facet.at[n]).norm()});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FacetEdge& a, const FacetEdge& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return edges;
}

std::vector<EdgeAngle> angles_at_edges(const std::vector<NumberedFacet>& facets,
                                       const std::vector<Vec3>& normals) {
  std::vector<EdgeAngle> angles;
  const std::vector<FacetEdge> edges = sorted_edges(facets);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low &&
           edges[last].high == edges[first].high) {
      ++last;
    }
    if (last - first == 2 && edges[first].upwards != edges[first + 1].upwards) {
      const Vec3 &a = normals[edges[first].facet], &b = normals[edges[first + 1].facet];
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      angles.push_back({angle, edges[first].length_mm});
    }
    first = last;
  }
  return angles;
}

double weighted_percentile95(std::vector<EdgeAngle>& angles, double total) {
  std::sort(angles.begin(), angles.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
  double below = 0;
  for (const auto& [angle, length] : angles) {
    below += length;
    if (below >= 0.95 * total) {
      return angle;
    }
  }
  return angles.back().angle;
}

}  // namespace

std::optional<Smoothness> smoothness(const std::vector<NumberedFacet>& facets) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  std::vector<Vec3> normals(facets.size());
  Smoothness result;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    normals[f] = area_vector(facets[f]);
    result.area_mm2 += normals[f].norm();
  }
  std::vector<EdgeAngle> angles = angles_at_edges(facets, normals);
  double total = 0, sum = 0, squares = 0;
  for (const auto& [angle, length] : angles) {
    total += length;
    sum += length * angle;
    squares += length * angle * angle;
    result.max_angle_deg = std::max(result.max_angle_deg, angle * kDegrees);
  }
  if (!(total > 0) || !(result.area_mm2 > 0)) {
    return std::nullopt;
  }
  result.edges = static_cast<std::int64_t>(angles.size());
  result.mean_angle_deg = sum / total * kDegrees;
  result.rms_angle_deg = std::sqrt(squares / total) * kDegrees;
  result.p95_angle_deg = weighted_percentile95(angles, total) * kDegrees;
  result.bending_per_mm = 0.5 * sum / result.area_mm2;
  return result;
}

std::vector<NumberedFacet> numbered_facets(const Surface& surface, std::uint32_t label,
                                           const std::vector<Vec3>& points) {
  std::vector<NumberedFacet> facets;
  facets.reserve(surface.facets_of[label].size());
  for (const std::uint32_t f : surface.facets_of[label]) {
    const SurfaceFacet& facet = surface.facets[f];
    const std::size_t corners = facet.corners();
    NumberedFacet& numbered = facets.emplace_back();
    numbered.corner[3] = NumberedFacet::kNoCorner;
    for (std::size_t n = 0; n < corners; ++n) {
      const std::size_t from = facet.inside == label ? n : corners - 1 - n;
      numbered.corner[n] = facet.nodes[from];
      numbered.at[n] = points[facet.nodes[from]];
    }
  }
  return facets;
}

std::vector<NumberedFacet> numbered_facets(const std::vector<SmoothTriangle>& triangles) {
  std::vector<NumberedFacet> facets(triangles.size());
#pragma omp parallel for
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [triangle, other, corner] = triangles[t];
    facets[t] = {{corner[0], corner[1], corner[2], NumberedFacet::kNoCorner},
                 {triangle.a, triangle.b, triangle.c, triangle.c}};
  }
  return facets;
}

nlohmann::json to_json(const std::optional<Smoothness>& mesh, const std::optional<Smoothness>& smooth) {
  const auto figure = [](const std::optional<Smoothness>& of, double Smoothness::*member) {
    return of ? number_or_null((*of).*member) : nlohmann::json(nullptr);
  };
  std::optional<double> ratio, excess;
  if (mesh && smooth) {
    ratio = smooth->bending_per_mm > 0 ? std::optional(mesh->bending_per_mm / smooth->bending_per_mm)
                                       : std::nullopt;
    excess = 100 * (mesh->area_mm2 / smooth->area_mm2 - 1);
  }
  return {{"facet_angle_mean_deg", figure(mesh, &Smoothness::mean_angle_deg)},
          {"facet_angle_rms_deg", figure(mesh, &Smoothness::rms_angle_deg)},
          {"facet_angle_p95_deg", figure(mesh, &Smoothness::p95_angle_deg)},
          {"facet_angle_max_deg", figure(mesh, &Smoothness::max_angle_deg)},
          {"bending_per_mm", figure(mesh, &Smoothness::bending_per_mm)},
          {"smooth_bending_per_mm", figure(smooth, &Smoothness::bending_per_mm)},
          {"bending_ratio", number_or_null(ratio)},
          {"area_excess_percent", number_or_null(excess)}};
}

}  // namespace cbc3d::metrics

#include "metrics/element_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "metrics/element_corners.hpp"
#include "metrics/element_quality.hpp"
#include "metrics/element_shapes.hpp"
#include "metrics/order_statistics.hpp"
#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPoorShape = 0.3;

// The edges of each kind of cell by local node numbers.
constexpr std::array<LocalEdge, 6> kTetEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<LocalEdge, 8> kPyramidEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<LocalEdge, 9> kWedgeEdges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<LocalEdge, 12> kHexEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

// The ideal corner W of a kind: 1 / det W and the entries of (W^T W)^-1, by which |T|^2 = sum of M_ij e_i .
// e_j.
struct IdealCorner {
  double inverse_det;
  Vec3 diagonal;  // M_11, M_22, M_33
  double m12, m13, m23;
};
constexpr double kSqrt3 = std::numbers::sqrt3, kSqrt2 = std::numbers::sqrt2;
constexpr IdealCorner kCubeCorner{1, {1, 1, 1}, 0, 0, 0};
// e1 . e2 = 1/2, e3 normal to both.
constexpr IdealCorner kWedgeCorner{2 / kSqrt3, {4.0 / 3, 4.0 / 3, 1}, -2.0 / 3, 0, 0};
// e1 . e2 = 0, e1 . e3 = e2 . e3 = 1/2; det W = sqrt(1/2).
constexpr IdealCorner kPyramidCorner{kSqrt2, {1.5, 1.5, 2}, 0.5, -1, -1};

double corner_mean_ratio(const Vec3& e1, const Vec3& e2, const Vec3& e3, const IdealCorner& ideal) {
  const double det = e1.dot(e2.cross(e3)) * ideal.inverse_det;
  const double squares = ideal.diagonal.x * e1.squared_norm() + ideal.diagonal.y * e2.squared_norm() +
                         ideal.diagonal.z * e3.squared_norm() +
                         2 * (ideal.m12 * e1.dot(e2) + ideal.m13 * e1.dot(e3) + ideal.m23 * e2.dot(e3));
  const double root = std::cbrt(det);
  return squares > 0 ? std::copysign(3 * root * root / squares, det) : 0;
}

template <std::size_t Corners, std::size_t Points>
double smallest_mean_ratio(const std::array<Corner, Corners>& corners, const std::array<Vec3, Points>& p,
                           const IdealCorner& ideal) {
  return smallest_at_corners(corners, p, [&](const Vec3& e1, const Vec3& e2, const Vec3& e3) {
    return corner_mean_ratio(e1, e2, e3, ideal);
  });
}

double mean_ratio(const CellView& cell, const std::vector<Vec3>& points) {
  switch (cell.kind) {
    case CellKind::kTet:
      return mean_ratio_tet(node_positions<4>(cell, points));
    case CellKind::kPyramid:
      return mean_ratio_pyramid(node_positions<5>(cell, points));
    case CellKind::kWedge:
      return mean_ratio_wedge(node_positions<6>(cell, points));
    case CellKind::kHex:
      return mean_ratio_hex(node_positions<8>(cell, points));
  }
  return 0;
}

// The values of each measure, cells of one group side by side.
struct Values {
  std::vector<float> mean_ratio, edge_ratio;      // of all cells
  std::vector<float> radius_ratio, height_ratio;  // of the tets, which come first within a group
};

// Where the cells of each group stand, and of these the tets.
struct Groups {
  std::vector<std::size_t> first, first_tet;  // and the ends
  std::vector<std::uint32_t> place;           // of every cell within its group
};

Groups groups_by_label(const MeshView& view) {
  const std::size_t labels = view.labels().size(), tets = view.mesh().tets.size();
  Groups groups{std::vector<std::size_t>(labels + 1, 0), std::vector<std::size_t>(labels + 1, 0),
                std::vector<std::uint32_t>(view.cell_count())};
  std::vector<std::uint32_t> size(labels, 0);
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const std::uint32_t label = view.label_index(c);
    groups.place[c] = size[label]++;
    groups.first_tet[label + 1] += c < tets ? 1 : 0;
  }
  for (std::size_t l = 0; l < labels; ++l) {
    groups.first[l + 1] = groups.first[l] + size[l];
    groups.first_tet[l + 1] += groups.first_tet[l];
  }
  return groups;
}

Values measure(const MeshView& view, const Groups& groups) {
  // The physical coordinates, in which a positive cell is positive whatever the image's axes are.
  const std::vector<Vec3>& points = view.mesh().points;
  Values values;
  values.mean_ratio.resize(view.cell_count());
  values.edge_ratio.resize(view.cell_count());
  values.radius_ratio.resize(view.mesh().tets.size());
  values.height_ratio.resize(view.mesh().tets.size());
#pragma omp parallel for schedule(static) if (view.cell_count() > kWorthThreads)
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const CellView cell = view.cell(c);
    const std::size_t label = view.label_index(c), at = groups.first[label] + groups.place[c];
    values.mean_ratio[at] = static_cast<float>(mean_ratio(cell, points));
    values.edge_ratio[at] = static_cast<float>(edge_ratio(cell, points));
    if (cell.kind == CellKind::kTet) {
      const auto p = node_positions<4>(cell, points);
      const std::size_t tet = groups.first_tet[label] + groups.place[c];
      values.radius_ratio[tet] = static_cast<float>(inverse_radius_ratio_tet(p));
      values.height_ratio[tet] = static_cast<float>(height_ratio_tet(p));
    }
  }
  return values;
}

std::optional<ShapeDistribution> shape_distribution(std::span<float> values) {
  const auto found = order_statistics(values, std::array<std::size_t, 5>{0, 1, 10, 50, 500});
  if (!found) {
    return std::nullopt;
  }
  const auto& [min, p0_1, p1, p5, median] = *found;
  return ShapeDistribution{min, p0_1, p1, p5, median, percent_below<float>(values, kPoorShape)};
}

std::optional<EdgeRatioDistribution> edge_ratio_distribution(std::span<float> values) {
  const auto found = order_statistics(values, std::array<std::size_t, 3>{500, 990, 1000});
  if (!found) {
    return std::nullopt;
  }
  return EdgeRatioDistribution{(*found)[0], (*found)[1], (*found)[2]};
}

// One of the four distributions of the cells from `first` on, and of the tets from `first_tet` on.
void find_distribution(std::size_t which, Values& values, std::array<std::size_t, 2> cells,
                       std::array<std::size_t, 2> tets, ElementShape& shape) {
  const auto part = [](std::vector<float>& of, const std::array<std::size_t, 2>& range) {
    return std::span(of).subspan(range[0], range[1] - range[0]);
  };
  switch (which) {
    case 0:
      shape.mean_ratio = shape_distribution(part(values.mean_ratio, cells));
      break;
    case 1:
      shape.edge_ratio = edge_ratio_distribution(part(values.edge_ratio, cells));
      break;
    case 2:
      shape.radius_ratio = shape_distribution(part(values.radius_ratio, tets));
      break;
    default:
      shape.height_ratio = shape_distribution(part(values.height_ratio, tets));
  }
}

// Finds the shape of each kind of cell. Values are measured a second time, since meshes of several kinds are
// rare.
void find_kinds(const MeshView& view, MeshShape& shape) {
  const Mesh& mesh = view.mesh();
  const std::array<std::size_t, 5> ends{0, mesh.tets.size(), mesh.tets.size() + mesh.pyramids.size(),
                                        mesh.tets.size() + mesh.pyramids.size() + mesh.wedges.size(),
                                        mesh.cell_count()};
  for (std::size_t kind = 0; kind < 4; ++kind) {
    if (ends[kind + 1] - ends[kind] == mesh.cell_count()) {
      shape.per_kind[kind] = shape.all;
      continue;
    }
    std::vector<float> ratios(ends[kind + 1] - ends[kind]), edges(ratios.size());
#pragma omp parallel for if (ratios.size() > kWorthThreads)
    for (std::size_t n = 0; n < ratios.size(); ++n) {
      const CellView cell = view.cell(ends[kind] + n);
      ratios[n] = static_cast<float>(mean_ratio(cell, mesh.points));
      edges[n] = static_cast<float>(edge_ratio(cell, mesh.points));
    }
    shape.per_kind[kind].mean_ratio = shape_distribution(ratios);
    shape.per_kind[kind].edge_ratio = edge_ratio_distribution(edges);
  }
}

json to_json(const std::optional<ShapeDistribution>& of) {
  if (!of) {
    return nullptr;
  }
  return {{"min", number_or_null(of->min)},       {"p0_1", number_or_null(of->p0_1)},
          {"p1", number_or_null(of->p1)},         {"p5", number_or_null(of->p5)},
          {"median", number_or_null(of->median)}, {"below_0_3_percent", of->below_0_3_percent}};
}

json to_json(const std::optional<EdgeRatioDistribution>& of) {
  if (!of) {
    return nullptr;
  }
  return {{"median", number_or_null(of->median)},
          {"p99", number_or_null(of->p99)},
          {"max", number_or_null(of->max)}};
}

void write_shape(json& object, const ElementShape& shape) {
  object["mean_ratio"] = to_json(shape.mean_ratio);
  object["radius_ratio"] = to_json(shape.radius_ratio);
  object["height_ratio"] = to_json(shape.height_ratio);
  object["edge_ratio"] = to_json(shape.edge_ratio);
}

}  // namespace

std::span<const LocalEdge> edges_of(CellKind kind) {
  switch (kind) {
    case CellKind::kTet:
      return kTetEdges;
    case CellKind::kPyramid:
      return kPyramidEdges;
    case CellKind::kWedge:
      return kWedgeEdges;
    case CellKind::kHex:
      return kHexEdges;
  }
  return {};
}

double mean_ratio_pyramid(const std::array<Vec3, 5>& p) {
  return smallest_mean_ratio(kPyramidBaseCorners, p, kPyramidCorner);
}

double mean_ratio_wedge(const std::array<Vec3, 6>& p) {
  return smallest_mean_ratio(kWedgeCorners, p, kWedgeCorner);
}

double mean_ratio_hex(const std::array<Vec3, 8>& p) {
  return smallest_mean_ratio(kHexCorners, p, kCubeCorner);
}

double inverse_radius_ratio_tet(const std::array<Vec3, 4>& p) {
  const double ratio = radius_ratio_tet(p);
  return std::isfinite(ratio) && ratio > 0 ? 1 / ratio : 0;
}

double height_ratio_tet(const std::array<Vec3, 4>& p) {
  double longest = 0;
  for (const auto& [a, b] : kTetEdges) {
    longest = std::max(longest, (p[a] - p[b]).squared_norm());
  }
  double largest_face = 0;  // twice its area
  for (std::size_t opposite = 0; opposite < 4; ++opposite) {
    const Vec3 &a = p[(opposite + 1) % 4], &b = p[(opposite + 2) % 4], &c = p[(opposite + 3) % 4];
    largest_face = std::max(largest_face, (b - a).cross(c - a).norm());
  }
  const double volume = std::fabs(six_volumes(p[0], p[1], p[2], p[3]));
  return largest_face > 0 ? std::sqrt(1.5 / longest) * volume / largest_face : 0;
}

double edge_ratio(const CellView& cell, const std::vector<Vec3>& points) {
  double longest = 0, shortest = kInfinity;
  for (const auto& [a, b] : edges_of(cell.kind)) {
    const double squared = (points[cell.nodes[a]] - points[cell.nodes[b]]).squared_norm();
    longest = std::max(longest, squared);
    shortest = std::min(shortest, squared);
  }
  return shortest > 0 ? std::sqrt(longest / shortest) : kInfinity;
}

MeshShape element_shape(const MeshView& view) {
  constexpr std::size_t kMeasures = 4;
  const Groups groups = groups_by_label(view);
  Values values = measure(view, groups);
  MeshShape shape;
  shape.per_label.resize(view.labels().size() <= kMostLabelsInFull ? view.labels().size() : 0);
#pragma omp parallel for schedule(dynamic) if (view.cell_count() > kWorthThreads)
  for (std::size_t n = 0; n < kMeasures * shape.per_label.size(); ++n) {
    const std::size_t l = n / kMeasures;
    find_distribution(n % kMeasures, values, {groups.first[l], groups.first[l + 1]},
                      {groups.first_tet[l], groups.first_tet[l + 1]}, shape.per_label[l]);
  }
#pragma omp parallel for schedule(dynamic) if (view.cell_count() > kWorthThreads)
  for (std::size_t which = 0; which < kMeasures; ++which) {
    find_distribution(which, values, {0, groups.first.back()}, {0, groups.first_tet.back()}, shape.all);
  }
  find_kinds(view, shape);
  return shape;
}

void write_json(json& quality, const MeshShape& shape) {
  write_shape(quality, shape.all);
  constexpr std::array<const char*, 4> kKinds{"tets", "pyramids", "wedges", "hexes"};
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    quality["shape_per_kind"][kKinds[kind]] = {{"mean_ratio", to_json(shape.per_kind[kind].mean_ratio)},
                                               {"edge_ratio", to_json(shape.per_kind[kind].edge_ratio)}};
  }
  for (std::size_t l = 0; l < shape.per_label.size(); ++l) {
    write_shape(quality["per_label"][l], shape.per_label[l]);
  }
}

}  // namespace cbc3d::metrics

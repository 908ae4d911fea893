#include "metrics/element_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double safe_ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : 0;
}

// Determinant of three edges over the product of their lengths.
double corner_jacobian(const Vec3& e1, const Vec3& e2, const Vec3& e3) {
  return safe_ratio(e1.dot(e2.cross(e3)), e1.norm() * e2.norm() * e3.norm());
}

struct Corner {
  std::size_t at, next, previous, up;  // right-handed edges from `at`
};

template <std::size_t Corners, std::size_t Points>
double smallest_corner(const std::array<Corner, Corners>& corners, const std::array<Vec3, Points>& p) {
  double smallest = kInfinity;
  for (const Corner& c : corners) {
    const Vec3& o = p[c.at];
    smallest = std::min(smallest, corner_jacobian(p[c.next] - o, p[c.previous] - o, p[c.up] - o));
  }
  return smallest;
}

constexpr std::array<Corner, 4> kPyramidCorners{{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
constexpr std::array<Corner, 6> kWedgeCorners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<Corner, 8> kHexCorners{{{0, 1, 3, 4},
                                             {1, 2, 0, 5},
                                             {2, 3, 1, 6},
                                             {3, 0, 2, 7},
                                             {4, 7, 5, 0},
                                             {5, 4, 6, 1},
                                             {6, 5, 7, 2},
                                             {7, 6, 4, 3}}};

// Running figures of one thread; merging is exact (min, max, integer sums), so its order does not matter.
struct Running {
  double min_dihedral = kInfinity, max_dihedral = -kInfinity;
  std::array<std::int64_t, kDihedralBins> histogram{};
  double tets = kInfinity, pyramids = kInfinity, pyramids_bcc = kInfinity, wedges = kInfinity,
         hexes = kInfinity;
  std::int64_t inverted = 0;

  void merge(const Running& o) {
    min_dihedral = std::min(min_dihedral, o.min_dihedral);
    max_dihedral = std::max(max_dihedral, o.max_dihedral);
    for (std::size_t b = 0; b < kDihedralBins; ++b) {
      histogram[b] += o.histogram[b];
    }
    tets = std::min(tets, o.tets);
    pyramids = std::min(pyramids, o.pyramids);
    pyramids_bcc = std::min(pyramids_bcc, o.pyramids_bcc);
    wedges = std::min(wedges, o.wedges);
    hexes = std::min(hexes, o.hexes);
    inverted += o.inverted;
  }
};

template <std::size_t N>
std::array<Vec3, N> corners_of(const CellView& cell, const std::vector<Vec3>& points) {
  std::array<Vec3, N> p;
  for (std::size_t n = 0; n < N; ++n) {
    p[n] = points[cell.nodes[n]];
  }
  return p;
}

void add_tet(const std::array<Vec3, 4>& p, Running& running) {
  for (const double angle : dihedral_angles_deg(p[0], p[1], p[2], p[3])) {
    running.min_dihedral = std::min(running.min_dihedral, angle);
    running.max_dihedral = std::max(running.max_dihedral, angle);
    ++running.histogram[dihedral_bin(angle)];
  }
  running.tets = std::min(running.tets, scaled_jacobian_tet(p));
}

bool is_inverted(const CellView& cell, const std::vector<Vec3>& points) {
  const TetSplit split = split_into_tets(cell);
  double volume = 0;
  for (int t = 0; t < split.count; ++t) {
    const auto& tet = split.tets[static_cast<std::size_t>(t)];
    volume += six_volumes(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]);
  }
  return !(volume > 0);
}

void add_cell(const CellView& cell, const std::vector<Vec3>& points, Running& running) {
  running.inverted += is_inverted(cell, points) ? 1 : 0;
  switch (cell.kind) {
    case CellKind::kTet:
      return add_tet(corners_of<4>(cell, points), running);
    case CellKind::kPyramid: {
      const auto p = corners_of<5>(cell, points);
      running.pyramids = std::min(running.pyramids, scaled_jacobian_pyramid(p));
      running.pyramids_bcc = std::min(running.pyramids_bcc, scaled_jacobian_pyramid_bcc(p));
      return;
    }
    case CellKind::kWedge:
      running.wedges = std::min(running.wedges, scaled_jacobian_wedge(corners_of<6>(cell, points)));
      return;
    case CellKind::kHex:
      running.hexes = std::min(running.hexes, scaled_jacobian_hex(corners_of<8>(cell, points)));
      return;
  }
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<double> min_of(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

}  // namespace

std::array<double, 6> dihedral_angles_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // Outward area vectors n0..n3 of the faces opposite each node. The cross product of two of them is six
  // volumes times their common edge, which gives the sine without cancellation.
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const std::array<Vec3, 4> n{bc.cross(bd), ad.cross(ac), ab.cross(ad), ac.cross(ab)};
  const double six_volume = std::fabs(ab.dot(ac.cross(ad)));
  const auto angle = [&](const Vec3& edge, std::size_t f, std::size_t g) {
    return std::atan2(six_volume * edge.norm(), -n[f].dot(n[g])) * (180 / std::numbers::pi);
  };
  return {angle(ab, 2, 3), angle(ac, 1, 3), angle(ad, 1, 2),
          angle(bc, 0, 3), angle(bd, 0, 2), angle(cd, 0, 1)};
}

double scaled_jacobian_tet(const std::array<Vec3, 4>& p) {
  const double l01 = (p[1] - p[0]).norm(), l02 = (p[2] - p[0]).norm(), l03 = (p[3] - p[0]).norm();
  const double l12 = (p[2] - p[1]).norm(), l13 = (p[3] - p[1]).norm(), l23 = (p[3] - p[2]).norm();
  const double jacobian = six_volumes(p[0], p[1], p[2], p[3]);
  const double largest =
      std::max({l01 * l02 * l03, l01 * l12 * l13, l02 * l12 * l23, l03 * l13 * l23, std::fabs(jacobian)});
  return safe_ratio(std::numbers::sqrt2 * jacobian, largest);
}

double scaled_jacobian_pyramid(const std::array<Vec3, 5>& p) {
  const double smallest = std::min(
      {scaled_jacobian_tet({p[0], p[1], p[2], p[4]}), scaled_jacobian_tet({p[0], p[2], p[3], p[4]}),
       scaled_jacobian_tet({p[0], p[1], p[3], p[4]}), scaled_jacobian_tet({p[1], p[2], p[3], p[4]})});
  if (smallest <= 0) {
    return 0;
  }
  const double scaled = smallest * std::numbers::sqrt2;
  return scaled < 1 ? scaled : 2 - scaled;
}

double scaled_jacobian_pyramid_bcc(const std::array<Vec3, 5>& p) {
  return std::numbers::sqrt3 * smallest_corner(kPyramidCorners, p);
}

double scaled_jacobian_wedge(const std::array<Vec3, 6>& p) {
  return 2 / std::numbers::sqrt3 * smallest_corner(kWedgeCorners, p);
}

double scaled_jacobian_hex(const std::array<Vec3, 8>& p) {
  const Vec3 x = (p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]);
  const Vec3 y = (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]);
  const Vec3 z = (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]);
  return std::min(smallest_corner(kHexCorners, p), corner_jacobian(x, y, z));
}

std::size_t dihedral_bin(double angle_deg) {
  constexpr double kSnapDeg = 1e-6;
  const double bin = std::floor((angle_deg + kSnapDeg) / kDihedralBinDeg);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kDihedralBins - 1)));
}

ElementQuality element_quality(const MeshView& view) {
  // On the physical coordinates: there a positive cell is positive whatever the image's axes.
  const std::vector<Vec3>& points = view.mesh().points;
  Running total;
#pragma omp parallel
  {
    Running mine;
#pragma omp for nowait schedule(static)
    for (std::size_t c = 0; c < view.cell_count(); ++c) {
      add_cell(view.cell(c), points, mine);
    }
#pragma omp critical(cbc3d_element_quality)
    total.merge(mine);
  }
  ElementQuality quality;
  quality.min_dihedral_deg = finite(total.min_dihedral);
  quality.max_dihedral_deg = finite(total.max_dihedral);
  quality.dihedral_histogram = total.histogram;
  quality.min_sj_tets = finite(total.tets);
  quality.min_sj_pyramids = finite(total.pyramids);
  quality.min_sj_pyramids_bcc = finite(total.pyramids_bcc);
  quality.min_sj_wedges = finite(total.wedges);
  quality.min_sj_hexes = finite(total.hexes);
  quality.inverted = total.inverted;
  return quality;
}

nlohmann::json to_json(const ElementQuality& quality) {
  const std::optional<double> smallest = min_of(min_of(quality.min_sj_tets, quality.min_sj_pyramids),
                                                min_of(quality.min_sj_wedges, quality.min_sj_hexes));
  return {{"min_dihedral_deg", number_or_null(quality.min_dihedral_deg)},
          {"max_dihedral_deg", number_or_null(quality.max_dihedral_deg)},
          {"dihedral_histogram_5deg", quality.dihedral_histogram},
          {"min_scaled_jacobian", number_or_null(smallest)},
          {"min_scaled_jacobian_tets", number_or_null(quality.min_sj_tets)},
          {"min_scaled_jacobian_pyramids", number_or_null(quality.min_sj_pyramids)},
          {"min_scaled_jacobian_pyramids_bcc", number_or_null(quality.min_sj_pyramids_bcc)},
          {"min_scaled_jacobian_wedges", number_or_null(quality.min_sj_wedges)},
          {"min_scaled_jacobian_hexes", number_or_null(quality.min_sj_hexes)},
          {"inverted", quality.inverted}};
}

}  // namespace cbc3d::metrics

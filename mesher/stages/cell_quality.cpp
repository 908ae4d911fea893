#include "mesher/stages/cell_quality.hpp"

#include <algorithm>
#include <cstdint>

namespace cbc3d {
namespace {

/// det(a, b, c) / (|a| |b| |c|), 0 when an edge has no length.
double scaled_det(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double lengths = std::sqrt(a.squared_norm() * b.squared_norm() * c.squared_norm());
  return lengths > 0 ? a.cross(b).dot(c) / lengths : 0;
}

/// The three neighbours of each hex corner, right-handed.
constexpr std::array<std::array<std::uint8_t, 3>, 8> kHexCornerNeighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

}  // namespace

double max_dihedral_cosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ad = d - a;
  const Vec3 base = ab.cross(ac);
  if (!(base.dot(ad) > 0)) {
    return 2;
  }
  const std::array<Vec3, 4> n = {(d - b).cross(c - b), ac.cross(ad), ad.cross(ab), base};
  std::array<double, 4> square{};
  for (std::size_t i = 0; i < 4; ++i) {
    square[i] = n[i].squared_norm();
  }
  // Inward normals of two faces at angle t have cosine -cos t. Signed squares spare the roots.
  double largest = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double dot = -n[i].dot(n[j]);
      const double signed_square = dot * std::fabs(dot) / (square[i] * square[j]);
      largest = signed_square > largest ? signed_square : largest;  // std::fmax is a call
    }
  }
  return std::copysign(std::sqrt(std::fabs(largest)), largest);
}

bool has_no_cosine_above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double cosine) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ad = d - a;
  const Vec3 base = ab.cross(ac);
  if (!(base.dot(ad) > 0) || cosine < 0) {
    return false;
  }
  const Vec3 n1 = ac.cross(ad);
  const Vec3 n2 = ad.cross(ab);
  const Vec3 n0 = -(n1 + n2 + base);  // the faces of a closed surface add up to nothing
  constexpr double kSure = 1 - 1e-9;  // what rounding leaves open is not said to be so
  const double square = cosine * cosine * kSure;
  const double s0 = n0.squared_norm();
  const double s1 = n1.squared_norm();
  const double s2 = n2.squared_norm();
  const double s3 = base.squared_norm();
  const auto within = [&](double dot, double squares) { return dot >= 0 || dot * dot <= square * squares; };
  return within(n0.dot(n1), s0 * s1) && within(n0.dot(n2), s0 * s2) && within(n0.dot(base), s0 * s3) &&
         within(n1.dot(n2), s1 * s2) && within(n1.dot(base), s1 * s3) && within(n2.dot(base), s2 * s3);
}

double min_dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double cosine = max_dihedral_cosine(a, b, c, d);
  return cosine > 1 ? 0 : std::acos(std::fmin(1, cosine)) * 180 / std::numbers::pi;
}

double scaled_jacobian_pyramid(std::span<const Vec3, 5> p) {
  double smallest = 1;
  for (std::size_t n = 0; n < 4; ++n) {
    smallest = std::fmin(smallest, std::numbers::sqrt3 *
                                       scaled_det(p[(n + 1) % 4] - p[n], p[(n + 3) % 4] - p[n], p[4] - p[n]));
  }
  return smallest;
}

double scaled_jacobian_hex(std::span<const Vec3, 8> p) {
  double smallest = scaled_det((p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]),
                               (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]),
                               (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]));
  for (std::size_t n = 0; n < 8; ++n) {
    const auto& near = kHexCornerNeighbours[n];
    smallest = std::fmin(smallest, scaled_det(p[near[0]] - p[n], p[near[1]] - p[n], p[near[2]] - p[n]));
  }
  return smallest;
}

}  // namespace cbc3d

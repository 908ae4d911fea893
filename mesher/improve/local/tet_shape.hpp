// Shape of one tet: the quality that guards bound, and a smooth energy for moves.
//
// Notation: sine_squared  the smallest squared sine of a tet's six dihedral angles, so that 20 and 160
//                         degrees are equally bad;
//           mean ratio    12 (3 V)^(2/3) / E with V the volume and E the sum of the squared edge lengths: 1
//                         for the regular tet, 0 for a flat one (Liu and Joe, BIT 34, 1994);
//           edge ratio    the longest edge over the shortest one;
//           quality       the smallest of sine_squared, kMeanRatioShare (mean ratio)^1.5 and
//                         kEdgeRatioShare / (edge ratio)^2; -1 for a tet without volume or turned inside out.
//                         Angles alone let pass what interpolates and conditions badly: tets with one edge
//                         many times as long as another.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// The factor of the mean ratio's term: a worst angle of 20 degrees is as good as a mean ratio of .30, one of
/// 35 degrees as one of .60.
inline constexpr double kMeanRatioShare = 0.7;

/// The factor of the edge ratio's term: a worst angle of 20 degrees is as good as an edge ratio of 5.8, one
/// of 35 degrees as one of 3.5.
inline constexpr double kEdgeRatioShare = 4;

/// The quality that a worst angle in degrees gives: the unit of all guards.
inline double quality_of_deg(double angle_deg) {
  const double sine = std::sin(angle_deg * std::numbers::pi / 180);
  return sine * sine;
}

/// Smallest sin^2 over the dihedral angles of tet a, b, c, d; -1 when its volume is not positive.
inline double min_sine_squared(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ad = d - a;
  const Vec3 n3 = ab.cross(ac);
  const double det = n3.dot(ad);
  if (!(det > 0)) {
    return -1;
  }
  // With face normals n_i, n_j of length twice the face area, |n_i x n_j| = det * (length of the edge that
  // the faces share), so sin^2 = det^2 e^2 / (|n_i|^2 |n_j|^2).
  const Vec3 n1 = ac.cross(ad);
  const Vec3 n2 = ad.cross(ab);
  const Vec3 bc = c - b;
  const Vec3 bd = d - b;
  const Vec3 cd = d - c;
  const double s0 = bc.cross(bd).squared_norm();
  const double s1 = n1.squared_norm();
  const double s2 = n2.squared_norm();
  const double s3 = n3.squared_norm();
  const double smallest =
      std::min({ab.squared_norm() * (s0 * s1), ac.squared_norm() * (s0 * s2), ad.squared_norm() * (s0 * s3),
                bc.squared_norm() * (s1 * s2), bd.squared_norm() * (s1 * s3), cd.squared_norm() * (s2 * s3)});
  const double product = s0 * s1 * (s2 * s3);
  return product > 0 ? det * det * smallest / product : -1;
}

/// The quality of tet a, b, c, d. With det = 6 V, the mean ratio to the power 1.5 is 12^1.5 / 2 det / E^1.5.
inline double tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kFactor = kMeanRatioShare * 20.784609690826528;  // 12^1.5 / 2
  const double angles = min_sine_squared(a, b, c, d);
  if (angles <= 0) {
    return angles;
  }
  const double det = (b - a).cross(c - a).dot(d - a);
  const std::array<double, 6> squares = {(b - a).squared_norm(), (c - a).squared_norm(),
                                         (d - a).squared_norm(), (c - b).squared_norm(),
                                         (d - b).squared_norm(), (d - c).squared_norm()};
  const double edges = squares[0] + squares[1] + squares[2] + squares[3] + squares[4] + squares[5];
  const double shortest = std::min({squares[0], squares[1], squares[2], squares[3], squares[4], squares[5]});
  const double longest = std::max({squares[0], squares[1], squares[2], squares[3], squares[4], squares[5]});
  return std::min({angles, kFactor * det / (edges * std::sqrt(edges)), kEdgeRatioShare * shortest / longest});
}

/// The inverse mean ratio (Liu and Joe, BIT 34, 1994) to the power p = 3, with its derivatives by the first
/// vertex. With A = sum of squared edge lengths / 2 and D = 6 sqrt(2) volume, it is (A / (3 D^(2/3)))^p: 1
/// for the regular tet, infinite for a flat one.
struct ShapeTerm {
  double energy = 0;
  Vec3 gradient;
  std::array<double, 6> hessian{};  ///< xx, yy, zz, xy, xz, yz; positive definite (a term is left out)
};

/// (inverse mean ratio)^3, negative when the tet x, b, c, d is not positive.
inline double shape_energy(const Vec3& x, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 xb = b - x;
  const Vec3 xc = c - x;
  const Vec3 xd = d - x;
  const double det = xb.cross(xc).dot(xd);
  if (!(det > 0)) {
    return -1;
  }
  const double edges = xb.squared_norm() + xc.squared_norm() + xd.squared_norm() + (c - b).squared_norm() +
                       (d - b).squared_norm() + (d - c).squared_norm();
  // (A/3)^3 / D^2 with A = edges / 2 and D^2 = 2 det^2.
  return edges * edges * edges / (432 * det * det);
}

/// The same with derivatives by x.
inline bool add_shape_term(const Vec3& x, const Vec3& b, const Vec3& c, const Vec3& d, ShapeTerm& sum) {
  const Vec3 normal = (b - d).cross(c - d);  // -d(det)/dx
  const double det = normal.dot(d - x);
  if (!(det > 0)) {
    return false;
  }
  const Vec3 to_b = x - b;
  const Vec3 to_c = x - c;
  const Vec3 to_d = x - d;
  const double edges = to_b.squared_norm() + to_c.squared_norm() + to_d.squared_norm() +
                       (c - b).squared_norm() + (d - b).squared_norm() + (d - c).squared_norm();
  const double energy = edges * edges * edges / (432 * det * det);
  const Vec3 by_edges = (2 / edges) * (to_b + to_c + to_d);
  const Vec3 by_det = (-1 / det) * normal;
  const Vec3 g = 3 * by_edges - 2 * by_det;  // gradient of ln(energy)
  sum.energy += energy;
  sum.gradient += energy * g;
  // Hessian of exp(ln E) = E (g g' + ln E''), without -3 by_edges by_edges', which is not positive.
  const double diagonal = 18 / edges;
  sum.hessian[0] += energy * (g.x * g.x + diagonal + 2 * by_det.x * by_det.x);
  sum.hessian[1] += energy * (g.y * g.y + diagonal + 2 * by_det.y * by_det.y);
  sum.hessian[2] += energy * (g.z * g.z + diagonal + 2 * by_det.z * by_det.z);
  sum.hessian[3] += energy * (g.x * g.y + 2 * by_det.x * by_det.y);
  sum.hessian[4] += energy * (g.x * g.z + 2 * by_det.x * by_det.z);
  sum.hessian[5] += energy * (g.y * g.z + 2 * by_det.y * by_det.z);
  return true;
}

/// Adds the energy weight / 2 * offset^2 of the distance from a plane with unit normal n.
inline void add_plane_term(const Vec3& n, double offset, double weight, ShapeTerm& sum) {
  sum.energy += 0.5 * weight * offset * offset;
  sum.gradient += (weight * offset) * n;
  sum.hessian[0] += weight * n.x * n.x;
  sum.hessian[1] += weight * n.y * n.y;
  sum.hessian[2] += weight * n.z * n.z;
  sum.hessian[3] += weight * n.x * n.y;
  sum.hessian[4] += weight * n.x * n.z;
  sum.hessian[5] += weight * n.y * n.z;
}

/// The Newton step -H^-1 g of a term, zero where H is singular.
inline Vec3 newton_step(const ShapeTerm& term) {
  const auto& h = term.hessian;
  const Vec3 r0 = {h[0], h[3], h[4]};
  const Vec3 r1 = {h[3], h[1], h[5]};
  const Vec3 r2 = {h[4], h[5], h[2]};
  const Vec3 c0 = r1.cross(r2);
  const double det = r0.dot(c0);
  if (!(std::fabs(det) > 0)) {
    return {};
  }
  const Vec3& g = term.gradient;
  return (-1 / det) * (g.x * c0 + g.y * r2.cross(r0) + g.z * r0.cross(r1));
}

}  // namespace cbc3d

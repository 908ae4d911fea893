#include "metrics/element_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/element_corners.hpp"

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
  return std::numbers::sqrt3 * smallest_at_corners(kPyramidBaseCorners, p, corner_jacobian);
}

double scaled_jacobian_wedge(const std::array<Vec3, 6>& p) {
  return 2 / std::numbers::sqrt3 * smallest_at_corners(kWedgeCorners, p, corner_jacobian);
}

double scaled_jacobian_hex(const std::array<Vec3, 8>& p) {
  const Vec3 x = (p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]);
  const Vec3 y = (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]);
  const Vec3 z = (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]);
  return std::min(smallest_at_corners(kHexCorners, p, corner_jacobian), corner_jacobian(x, y, z));
}

double radius_ratio_tet(const std::array<Vec3, 4>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double six_volume = std::fabs(a.dot(bc));
  const double double_area = bc.norm() + ca.norm() + ab.norm() + (b - a).cross(c - a).norm();
  const Vec3 centre = a.squared_norm() * bc + b.squared_norm() * ca + c.squared_norm() * ab;
  // R = |centre| / (2 * 6V), r = 6V / double_area.
  const double ratio = centre.norm() * double_area / (6 * six_volume * six_volume);
  return six_volume > 0 ? ratio : kInfinity;
}

double mean_ratio_tet(const std::array<Vec3, 4>& p) {
  const double six_volume = six_volumes(p[0], p[1], p[2], p[3]);
  double edges = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      edges += (p[i] - p[j]).squared_norm();
    }
  }
  return std::copysign(safe_ratio(12 * std::pow(std::fabs(six_volume) / 2, 2.0 / 3), edges), six_volume);
}

}  // namespace cbc3d::metrics

// The quality measure of the deformation's quality control.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

/// The smallest dihedral angle of a tet, degrees; 0 or less for a flat or inverted tet.
inline double min_dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<Vec3, 4> n = {(d - b).cross(c - b), (c - a).cross(d - a), (d - a).cross(b - a),
                                 (b - a).cross(c - a)};
  if ((b - a).cross(c - a).dot(d - a) <= 0) {
    return 0;
  }
  double largest =
      -1;  // cosine of the smallest angle; inward normals of two faces at angle t have cosine -cos t
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      largest = std::fmax(largest, -n[i].dot(n[j]) / std::sqrt(n[i].squared_norm() * n[j].squared_norm()));
    }
  }
  return std::acos(std::fmin(1, largest)) * 180 / std::numbers::pi;
}

}  // namespace cbc3d

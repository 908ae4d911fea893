// Dihedral angles of tets, compared by the squares of their cosines: no root, no inverse cosine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mesher/core/vec3.hpp"

namespace cbc3d::baselines::ld {

/// The normals of a tet's faces, each opposite the corner of its number, all outward or all inward, of twice
/// the face's area. Corners 0, 1, 2 are given relative to corner 3.
inline std::array<Vec3, 4> face_normals(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n0 = b.cross(c);
  const Vec3 n1 = c.cross(a);
  const Vec3 n2 = a.cross(b);
  return {n0, n1, n2, -(n0 + n1 + n2)};
}

/// Bounds of the dihedral angles of a tet.
class DihedralBounds {
 public:
  /// Angles in degrees from `least` to `most`; `most` of 180 bounds nothing. What is accepted keeps a
  /// distance of 1e-9 radians from the bounds, so that rounding leaves them intact.
  DihedralBounds(double least_deg, double most_deg) {
    constexpr double kGuard = 1e-9;
    const double least = std::cos(std::fmin(least_deg * M_PI / 180 + kGuard, M_PI / 2));
    const double most = most_deg >= 180 ? -2 : std::cos(most_deg * M_PI / 180 - kGuard);
    least_squared_ = least * least;
    most_squared_ = most * most;
  }

  /// True when all six angles are within the bounds. Corners as for face_normals.
  [[nodiscard]] bool accept(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const std::array<Vec3, 4> n = face_normals(a, b, c);
    const std::array<double, 4> square{n[0].squared_norm(), n[1].squared_norm(), n[2].squared_norm(),
                                       n[3].squared_norm()};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double cosine = -n[i].dot(n[j]);  // times the lengths of both
        const double bound = cosine > 0 ? least_squared_ : most_squared_;
        if (cosine * cosine > bound * square[i] * square[j]) return false;
      }
    }
    return true;
  }

 private:
  double least_squared_;
  double most_squared_;
};

/// The smallest dihedral angle of a tet in degrees. Corners as for face_normals.
inline double least_dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 4> n = face_normals(a, b, c);
  double largest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      largest = std::fmax(largest, -n[i].dot(n[j]) / std::sqrt(n[i].squared_norm() * n[j].squared_norm()));
    }
  }
  return std::acos(std::clamp(largest, -1.0, 1.0)) * 180 / M_PI;
}

}  // namespace cbc3d::baselines::ld

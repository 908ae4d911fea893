// Dihedral angles by their cosines.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines::cleaver {

struct CosineRange {
  double least, most;  ///< cosines of the largest and of the smallest angle
};

/// The range of the cosines of a tet's six dihedral angles; {-2, 2} for a flat or inverted one.
inline CosineRange dihedral_cosines(const std::array<Vec3, 4>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3 ab = a.cross(b);
  if (!(ab.dot(c) > 0)) return {-2, 2};
  const std::array<Vec3, 4> inward = {ab.normalized(), c.cross(a).normalized(), b.cross(c).normalized(),
                                      (c - a).cross(b - a).normalized()};
  CosineRange range{2, -2};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -inward[i].dot(inward[j]);
      range.least = std::min(range.least, cosine);
      range.most = std::max(range.most, cosine);
    }
  }
  return range;
}

/// The larger of the two cosines' sizes: the smaller, the better the tet; 2 for a flat or inverted one.
inline double worst_cosine(const std::array<Vec3, 4>& p) {
  const CosineRange range = dihedral_cosines(p);
  return std::max(-range.least, range.most);
}

inline bool has_angles_within(const std::array<Vec3, 4>& p, double least_deg, double most_deg) {
  const CosineRange range = dihedral_cosines(p);
  constexpr double kDegree = std::numbers::pi / 180;
  return range.most <= std::cos(least_deg * kDegree) && range.least >= std::cos(most_deg * kDegree);
}

}  // namespace cbc3d::baselines::cleaver

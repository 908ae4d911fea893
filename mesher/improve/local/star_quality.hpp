// The quality of a vertex's star, that of its worst tet, as a function of the vertex's place: what
// optimisation-based smoothing maximises (Freitag and Ollivier-Gooch, Int. J. Numer. Meth. Engng 40, 1997).
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {

/// The outer faces of a vertex's star: with the vertex in front each is one of its tets, positively oriented.
using Link = std::vector<std::array<Vec3, 3>>;

/// The quality of a tet with its vertex at x. For a tet that is not positive it is a value
/// below -1 that falls with the volume, so that a search leads out of a tangled star too.
inline double quality(const Vec3& x, const std::array<Vec3, 3>& face) {
  const double value = tet_quality(x, face[0], face[1], face[2]);
  if (value >= 0) {
    return value;
  }
  const double side = (face[0] - face[1]).norm() + (face[1] - face[2]).norm() + (face[2] - face[0]).norm();
  const double volume = (face[0] - x).cross(face[1] - x).dot(face[2] - x);
  return side > 0 ? -1 + std::min(0.0, volume / (side * side * side)) : -1;
}

/// The lowest quality in the star with the vertex at x. The search ends at the first tet not above `floor`.
inline double worst_quality(const Link& link, const Vec3& x, double floor) {
  double smallest = 1;
  for (const auto& face : link) {
    smallest = std::min(smallest, quality(x, face));
    if (smallest <= floor) {
      return smallest;
    }
  }
  return smallest;
}

/// Direction in which the worst tet of the star improves most, by differences over a ten-thousandth of h.
inline Vec3 steepest_ascent(const Link& link, const Vec3& x, double h) {
  const std::array<Vec3, 3>* bad = &link.front();
  double smallest = 2;
  for (const auto& face : link) {
    const double s = quality(x, face);
    if (s < smallest) {
      smallest = s;
      bad = &face;
    }
  }
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 at = x;
    at[axis] += 1e-4 * h;
    gradient[axis] = quality(at, *bad) - smallest;
  }
  return gradient.normalized();
}

/// The direction of ascent first, then both directions along each axis.
inline std::array<Vec3, 7> search_directions(const Vec3& up) {
  return {up, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}};
}

}  // namespace cbc3d

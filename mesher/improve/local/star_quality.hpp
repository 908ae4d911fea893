// The worst angle of the tets round a vertex as a function of its place, and the ways up from there.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {

/// The outer faces of a vertex's star: with the vertex in front each is one of its tets, positively oriented.
using Link = std::vector<std::array<Vec3, 3>>;

/// The worst angle of a tet, as sin^2; where it is not positive something below that falls with its volume,
/// so that there is a way up even for a tangled one.
inline double height(const Vec3& x, const std::array<Vec3, 3>& face) {
  const double sine_squared = min_sine_squared(x, face[0], face[1], face[2]);
  if (sine_squared >= 0) {
    return sine_squared;
  }
  const double side = (face[0] - face[1]).norm() + (face[1] - face[2]).norm() + (face[2] - face[0]).norm();
  const double volume = (face[0] - x).cross(face[1] - x).dot(face[2] - x);
  return side > 0 ? -1 + std::min(0.0, volume / (side * side * side)) : -1;
}

/// The lowest height of the star with the vertex at x, given up below `floor`.
inline double worst_height(const Link& link, const Vec3& x, double floor) {
  double smallest = 1;
  for (const auto& face : link) {
    smallest = std::min(smallest, height(x, face));
    if (smallest <= floor) {
      return smallest;
    }
  }
  return smallest;
}

/// Direction in which the worst tet of the star improves most, felt out over a ten-thousandth of h.
inline Vec3 steepest_ascent(const Link& link, const Vec3& x, double h) {
  const std::array<Vec3, 3>* bad = &link.front();
  double smallest = 2;
  for (const auto& face : link) {
    const double s = height(x, face);
    if (s < smallest) {
      smallest = s;
      bad = &face;
    }
  }
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 at = x;
    at[axis] += 1e-4 * h;
    gradient[axis] = height(at, *bad) - smallest;
  }
  return gradient.normalized();
}

/// The way up first, then both ways along each axis.
inline std::array<Vec3, 7> climb_directions(const Vec3& up) {
  return {up, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}};
}

}  // namespace cbc3d

// The place of a triangle that is nearest to another place.
#pragma once

#include <array>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

/// A place on a triangle as weights of its corners.
struct TrianglePlace {
  Vec3 at;
  std::array<double, 3> weights;
};

/// Ericson: Real-Time Collision Detection, 2005, section 5.1.5. A triangle without area gives a place on one
/// of its sides.
inline TrianglePlace nearest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto place = [&](double u, double v, double w) {
    return TrianglePlace{u * a + v * b + w * c, {u, v, w}};
  };
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(x - a);
  const double d2 = ac.dot(x - a);
  if (d1 <= 0 && d2 <= 0) return place(1, 0, 0);
  const double d3 = ab.dot(x - b);
  const double d4 = ac.dot(x - b);
  if (d3 >= 0 && d4 <= d3) return place(0, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return place(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
  const double d5 = ab.dot(x - c);
  const double d6 = ac.dot(x - c);
  if (d6 >= 0 && d5 <= d6) return place(0, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return place(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  const double along = d4 - d3;
  const double back = d5 - d6;
  if (va <= 0 && along >= 0 && back >= 0) {
    const double w = along + back > 0 ? along / (along + back) : 0;
    return place(0, 1 - w, w);
  }
  const double sum = va + vb + vc;
  return place(1 - vb / sum - vc / sum, vb / sum, vc / sum);
}

}  // namespace cbc3d

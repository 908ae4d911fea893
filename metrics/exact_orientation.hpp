// On which side a point lies, free of rounding errors.
//
// A sign is first computed in doubles; where that is not larger than the bound of its rounding error it is
// computed again exactly, as an unevaluated sum of doubles (Shewchuk, Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates, 1997). Exact for coordinates whose products of three
// neither overflow nor underflow: lengths between 1e-90 and 1e90 are far from both.
#pragma once

#include <array>

#include "mesher/core/vec3.hpp"

namespace cbc3d::metrics {

/// Sign of the determinant |b-a, c-a, d-a|, of six_volumes(a, b, c, d): 1 when d lies where b, c and the
/// normal by the right-hand rule point, seen from a; -1 on the other side; 0 in the plane.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the area of a, b, c in a plane: 1 counter-clockwise, -1 clockwise, 0 on a line.
using Point2 = std::array<double, 2>;
int orientation(const Point2& a, const Point2& b, const Point2& c);

}  // namespace cbc3d::metrics

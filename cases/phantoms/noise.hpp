// Smooth noise in space, from additions, multiplications and integer hashes alone.
#pragma once

#include <cstdint>

#include "mesher/core/vec3.hpp"

namespace cbc3d::cases {

/// Gradient noise (Perlin 2002) on the integer lattice: about [-1,1], zero at lattice points, features one
/// unit long.
double gradient_noise(std::uint64_t seed, const Vec3& p);

/// Cosine and sine of an angle in turns, by a polynomial: the same bits on every machine.
struct CircleNumbers {
  double cosine, sine;
};
CircleNumbers circle_at(double turns);

}  // namespace cbc3d::cases

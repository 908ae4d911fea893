// Seeded draws that are the same on every platform, which the standard's distributions are not.
#pragma once

#include <random>

#include "mesher/core/vec3.hpp"

namespace cbc3d::testing {

/// Uniform in [low, high).
inline double draw(std::mt19937& random, double low, double high) {
  return low + (high - low) * (random() / 4294967296.0);
}

/// Each coordinate uniform in [low, high).
inline Vec3 draw_point(std::mt19937& random, double low, double high) {
  const double x = draw(random, low, high);
  const double y = draw(random, low, high);
  return {x, y, draw(random, low, high)};
}

}  // namespace cbc3d::testing

// Numbers that are a function of a seed and a counter alone: any thread may draw any of them.
#pragma once

#include <cstdint>

#include "mesher/core/vec3.hpp"

namespace cbc3d::cases {

/// Mixes all bits of its argument (the finaliser of SplitMix64).
inline std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// The `counter`-th number of a seed's sequence, in [0,1).
inline double uniform_at(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(mix_bits(mix_bits(seed) ^ counter) >> 11U) * 0x1.0p-53;
}

/// A sequence drawn in order.
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed) : seed_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * uniform_at(seed_, counter_++); }
  Vec3 in_box(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  /// Uniform over the directions.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_box(1);
      const double squared = v.squared_norm();
      if (squared > 0.01 && squared <= 1) {
        return v.normalized();
      }
    }
  }

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

}  // namespace cbc3d::cases

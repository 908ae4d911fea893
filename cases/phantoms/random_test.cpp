#include "cases/phantoms/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::cases {
namespace {

TEST(MixBits, IsTheFinaliserOfSplitMix64) {
  // The first outputs of SplitMix64 with seed 0 (Steele, Lea and Flood, 2014).
  EXPECT_EQ(mix_bits(0), 0xE220A8397B1DCDAFULL);
  EXPECT_EQ(mix_bits(0x9E3779B97F4A7C15ULL), 0x6E789E6AA1B965F4ULL);
}

TEST(UniformAt, IsEvenlySpreadAndRepeatable) {
  double sum = 0;
  for (std::uint64_t n = 0; n < 10000; ++n) {
    const double value = uniform_at(7, n);
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    ASSERT_EQ(value, uniform_at(7, n));
    sum += value;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.02);
}

TEST(RandomSequence, DirectionsHaveLengthOneAndNoPreference) {
  RandomSequence random(3);
  Vec3 sum{};
  for (int n = 0; n < 5000; ++n) {
    const Vec3 direction = random.direction();
    ASSERT_NEAR(direction.norm(), 1, 1e-12);
    sum += direction;
  }
  EXPECT_LT(sum.norm() / 5000, 0.05);
}

}  // namespace
}  // namespace cbc3d::cases

#include "cases/phantoms/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cbc3d::cases {
namespace {

TEST(Noise, CircleIsThatOfTheLibrary) {
  for (int n = -500; n < 500; ++n) {
    const double turns = 0.01371 * n;
    EXPECT_NEAR(circle_at(turns).cosine, std::cos(2 * M_PI * turns), 1e-13) << turns;
    EXPECT_NEAR(circle_at(turns).sine, std::sin(2 * M_PI * turns), 1e-13) << turns;
  }
}

TEST(Noise, IsSmoothAndZeroOnTheLattice) {
  EXPECT_EQ(gradient_noise(1, {3, -4, 5}), 0);
  double least = 1, most = -1;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p{.37 * n, -.21 * n, .113 * n};
    const double here = gradient_noise(1, p);
    EXPECT_LT(std::abs(gradient_noise(1, p + Vec3{1e-3, 0, 0}) - here), 5e-3);
    least = std::min(least, here);
    most = std::max(most, here);
  }
  EXPECT_LT(least, -.5);
  EXPECT_GT(most, .5);
}

}  // namespace
}  // namespace cbc3d::cases

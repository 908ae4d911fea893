#include "mesher/core/nearest_on_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace cbc3d {
namespace {

const Vec3 kA{0, 0, 0}, kB{4, 0, 0}, kC{0, 3, 0};

void expect_place(const Vec3& x, const Vec3& expected) {
  const TrianglePlace place = nearest_on_triangle(x, kA, kB, kC);
  EXPECT_NEAR((place.at - expected).norm(), 0, 1e-12);
  const auto& w = place.weights;
  EXPECT_NEAR((w[0] * kA + w[1] * kB + w[2] * kC - expected).norm(), 0, 1e-12);
}

TEST(NearestOnTriangle, OfEveryRegionIsKnown) {
  expect_place({1, 1, 5}, {1, 1, 0});    // inside
  expect_place({-1, -2, 1}, {0, 0, 0});  // corners
  expect_place({9, -1, 2}, {4, 0, 0});
  expect_place({-1, 8, -2}, {0, 3, 0});
  expect_place({2, -3, 1}, {2, 0, 0});  // sides
  expect_place({-3, 2, 1}, {0, 2, 0});
  expect_place({2 + 3, 1.5 + 4, 1}, {2, 1.5, 0});
}

TEST(NearestOnTriangle, IsNoFartherThanAnyPlaceOfAGridAndAsNearAsTheBest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-1, 1);
  const auto any = [&] { return Vec3{draw(random), draw(random), draw(random)}; };
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 x = 2 * any(), a = any(), b = any(), c = any();
    constexpr int kSteps = 60;
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double u = double(i) / kSteps, v = double(j) / kSteps;
        best = std::min(best, (u * a + v * b + (1 - u - v) * c - x).norm());
      }
    }
    const double found = (nearest_on_triangle(x, a, b, c).at - x).norm();
    EXPECT_LE(found, best + 1e-12);
    EXPECT_GT(found, best - 0.06);  // no place is farther from the grid than its mesh, sides up to 3.5 long
  }
}

TEST(NearestOnTriangle, WithoutAreaIsOnASide) {
  const TrianglePlace place = nearest_on_triangle({1, 1, 0}, {0, 0, 0}, {2, 0, 0}, {1, 0, 0});
  EXPECT_NEAR((place.at - Vec3{1, 0, 0}).norm(), 0, 1e-12);
  EXPECT_EQ(nearest_on_triangle({1, 1, 0}, kA, kA, kA).at, kA);
}

}  // namespace
}  // namespace cbc3d

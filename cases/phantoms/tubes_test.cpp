#include "cases/phantoms/tubes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::cases {
namespace {

TEST(Tubes, RoundConeDistanceIsExact) {
  // By the angle of its side: a cone along x from radius 2 to 1 over 5, seen beside its middle.
  const RoundCone cone({{0, 0, 0}, 2}, {{5, 0, 0}, 1});
  const double sine = 1.0 / 5, cosine = std::sqrt(1 - sine * sine);
  const Vec3 on_axis{2, 0, 0}, normal{sine, cosine, 0};
  const double radius = 2 - 2 * sine;  // of the ball at on_axis that touches the side
  EXPECT_NEAR(cone.distance_mm(on_axis), -radius, 1e-12);
  EXPECT_NEAR(cone.distance_mm(on_axis + (radius + 3) * normal), 3, 1e-12);
  EXPECT_NEAR(cone.distance_mm({-5, 0, 0}), 3, 1e-12);
  EXPECT_NEAR(cone.distance_mm({9, 0, 0}), 3, 1e-12);
  EXPECT_NEAR(RoundCone({{0, 0, 0}, 2}, {{.5, 0, 0}, 1}).distance_mm({0, 6, 0}), 4, 1e-12);
  EXPECT_NEAR(RoundCone({{.5, 0, 0}, 1}, {{0, 0, 0}, 2}).distance_mm({0, 6, 0}), 4, 1e-12);
}

}  // namespace
}  // namespace cbc3d::cases

// Functions of signed distance as a domain: two balls and a half space, whose boundaries are known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "mesher/domain/distance_domain.hpp"

namespace cbc3d {
namespace {

constexpr Vec3 kCentre = {12, 12, 12};
constexpr double kRadius = 8;

DistanceDomain::Region ball(Label label, double radius_mm) {
  return {.label = label,
          .distance_mm = [radius_mm](const Vec3& x) { return radius_mm - (x - kCentre).norm(); }};
}

TEST(DistanceDomain, ABallHasItsExactDistancesAndVolume) {
  const DistanceDomain domain({ball(7, kRadius)}, {.size = {25, 25, 25}, .spacing_mm = 1});
  EXPECT_EQ(domain.labels(), (std::vector<Label>{0, 7}));
  EXPECT_EQ(domain.label_of(), (std::vector<MaterialId>{0, 1}));
  EXPECT_DOUBLE_EQ(domain.scale_mm(), std::sqrt(3.0));
  const double volume = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
  EXPECT_NEAR(domain.volumes_mm3()[1], volume, 0.02 * volume);
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    Vec3 out;
    for (int axis = 0; axis < 3; ++axis) out[axis] = random() / 4294967296.0 - 0.5;
    out = out.normalized();
    const double depth = 3 * (random() / 4294967296.0 - 0.5);
    const Vec3 x = kCentre + (kRadius - depth) * out;
    const BoundaryDistance d = domain.boundary_distance(x, 1, kBackground);
    EXPECT_NEAR(d.distance_mm, depth, 1e-6);
    EXPECT_NEAR(d.deviation_mm, std::fabs(depth), 1e-6);
    EXPECT_LT((d.normal + out).norm(), 1e-3);  // towards the ball
    EXPECT_NEAR(d.shifted(0.25).distance_mm, depth + 0.25, 1e-6);
    EXPECT_NEAR(domain.boundary_distance(x, kBackground, 1).distance_mm, -depth, 1e-6);
    EXPECT_EQ(domain.material_at(x), depth > 0 ? 1 : kBackground);
    for (const MaterialId m : {MaterialId{0}, MaterialId{1}}) {
      const Vec3 nearest = domain.nearest_boundary(x, m).value_or(kCentre);
      EXPECT_NEAR((nearest - kCentre).norm(), kRadius, 1e-3);
      EXPECT_TRUE(domain.is_near_boundary(x, m));
    }
  }
  EXPECT_TRUE(std::isinf(domain.boundary_distance(kCentre + Vec3{1, 0, 0}, 1, kBackground).deviation_mm));
  EXPECT_FALSE(domain.nearest_boundary(kCentre + Vec3{1, 0, 0}, 1).has_value());
}

TEST(DistanceDomain, SamplesAreTheCellsAtTheBoundaries) {
  const DistanceDomain domain({ball(7, kRadius)}, {.size = {25, 25, 25}, .spacing_mm = 1});
  ASSERT_GT(domain.samples().size(), 500U);
  for (const BoundarySample& s : domain.samples()) {
    EXPECT_EQ(s.own, 1);
    EXPECT_EQ(s.other, kBackground);
    const double depth = kRadius - (s.centre() - kCentre).norm();
    EXPECT_GT(depth, 0);
    EXPECT_LE(depth, 1);
    EXPECT_FALSE(domain.is_thin(s));
  }
}

TEST(DistanceDomain, ABoundaryEndsWhereAThirdLabelIs) {
  // Material 1: the ball's lower half, material 2: its upper one.
  const auto half = [](double sign) {
    return [sign](const Vec3& x) {
      return std::min(kRadius - (x - kCentre).norm(), sign * (x.z - kCentre.z - 0.3));
    };
  };
  const DistanceDomain domain({{.label = 3, .distance_mm = half(-1)}, {.label = 4, .distance_mm = half(1)}},
                              {.size = {25, 25, 25}, .spacing_mm = 1});
  const BoundaryDistance d = domain.boundary_distance(kCentre + Vec3{1, 2, 0.8}, 2, 1);
  EXPECT_NEAR(d.distance_mm, 0.5, 1e-6);
  EXPECT_LT((d.normal - Vec3{0, 0, 1}).norm(), 1e-6);
  EXPECT_TRUE(std::isinf(domain.boundary_distance(kCentre + Vec3{11.5, 0, 0.5}, 2, 1).deviation_mm));
  std::set<std::pair<MaterialId, MaterialId>> pairs;
  for (const BoundarySample& s : domain.samples()) pairs.emplace(s.own, s.other);
  EXPECT_EQ(pairs, (std::set<std::pair<MaterialId, MaterialId>>{
                       {1, 0},
                       {1, 2},
                       {2, 0},
                       {2, 1},
                   }));
}

}  // namespace
}  // namespace cbc3d

// Quality measures of cells, of known elements and against the quick test.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

TEST(CellQuality, OfUnitElementsAndTheirMirrorImages) {
  const std::array<Vec3, 8> cube = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  EXPECT_NEAR(scaled_jacobian_hex(cube), 1, 1e-15);
  std::array<Vec3, 8> mirrored;
  std::transform(cube.begin(), cube.end(), mirrored.begin(), [](const Vec3& p) {
    return Vec3{-p.x, p.y, p.z};
  });
  EXPECT_NEAR(scaled_jacobian_hex(mirrored), -1, 1e-15);
  const std::array<Vec3, 5> pyramid = {cube[0], cube[1], cube[2], cube[3], Vec3{0.5, 0.5, 0.5}};
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid), 1, 1e-15);
  EXPECT_LT(
      scaled_jacobian_pyramid(std::array<Vec3, 5>{cube[0], cube[1], cube[2], cube[3], Vec3{0.5, 0.5, -0.5}}),
      0);
  const double s = std::numbers::sqrt2;  // the lattice's tet: 60 and 90 degrees
  const std::array<Vec3, 4> tet = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}}};
  EXPECT_NEAR(min_dihedral_deg(tet[1], tet[0], tet[2], tet[3]), 60, 1e-9);
  EXPECT_EQ(min_dihedral_deg(tet[0], tet[1], tet[2], tet[3]), 0) << "inverted";
  EXPECT_NEAR(min_dihedral_deg({0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}),
              std::acos(1 / std::numbers::sqrt3) * 180 / std::numbers::pi, 1e-9);
}

/// Random tets from well shaped to slim, flat and inverted ones: what the quick test says is true, and it
/// says so of nearly all that are clearly above the bound.
TEST(CellQuality, QuickTestIsNeverWrongAndMostlyAnswers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 far = {300, -200, 500};
  std::size_t clear = 0;
  std::size_t answered = 0;
  for (int i = 0; i < 200000; ++i) {
    const double flat = std::pow(10, -4 * std::fabs(uniform(random)));
    std::array<Vec3, 4> p;
    for (Vec3& q : p) {
      q = far + Vec3{uniform(random), uniform(random), flat * uniform(random)};
    }
    for (const double bound_deg : {5.0, 20.0}) {
      const double bound = std::cos(bound_deg * std::numbers::pi / 180);
      const double cosine = max_dihedral_cosine(p[0], p[1], p[2], p[3]);
      const bool sure = surely_no_cosine_above(p[0], p[1], p[2], p[3], bound);
      EXPECT_TRUE(!sure || cosine <= bound) << cosine << " at " << bound_deg << " degrees";
      const bool is_clear = cosine < 0.99 * bound;
      clear += is_clear ? 1 : 0;
      answered += is_clear && sure ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 10000U);
  EXPECT_GT(static_cast<double>(answered), 0.95 * static_cast<double>(clear));
}

}  // namespace
}  // namespace cbc3d

#include "baselines/cleaver/uniform_bricks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

using cbc3d::testing::make_image;

// The materials of the voxels within reach of a place.
std::set<MaterialId> materials_within(const LabelImage& image, const Vec3& place, double reach) {
  std::set<MaterialId> found;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    bool within = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double voxel = place[axis] / image.frame.spacing_mm[axis];
      within = within && std::abs(at[static_cast<std::size_t>(axis)] - voxel) <= reach;
    }
    if (within) found.insert(image.voxels[v]);
  }
  return found;
}

TEST(UniformBricks, AUniformBrickHasItsMaterialAloneWithinReach) {
  constexpr double kReach = 2.5;
  const LabelImage image = make_image({45, 22, 19}, {1, 0.5, 2}, 2, [](const Vec3& p) {
    return p.x < 12 ? 1 : p.x > 30 ? 2 : 0;
  });
  const UniformBricks bricks(image, {kReach, kReach, kReach});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(0, 1);
  std::set<std::uint32_t> seen;
  for (int n = 0; n < 300; ++n) {
    const Vec3 place{-0.5 + 45 * within(random), -0.25 + 11 * within(random), -1 + 38 * within(random)};
    const std::uint32_t found = bricks.at(place);
    seen.insert(found);
    if (found == UniformBricks::kMixed) continue;
    EXPECT_EQ(materials_within(image, place, kReach), std::set<MaterialId>{static_cast<MaterialId>(found)});
  }
  EXPECT_EQ(seen, (std::set<std::uint32_t>{0, 1, 2, UniformBricks::kMixed}));
}

TEST(UniformBricks, OutsideTheImageTheNearestBrickCounts) {
  const LabelImage image =
      make_image({64, 8, 8}, {1, 1, 1}, 1, [](const Vec3& p) { return p.x < 20 ? 1 : 0; });
  const UniformBricks bricks(image, {1, 1, 1});
  EXPECT_EQ(bricks.at({-1e12, 1, 1}), 1U);
  EXPECT_EQ(bricks.at({1e12, 1, 1}), kBackground);
  EXPECT_TRUE(bricks.are_background({40, -5, -5}, {60, 20, 20}));
  EXPECT_FALSE(bricks.are_background({15, 0, 0}, {60, 7, 7}));
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

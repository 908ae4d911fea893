#include "baselines/cleaver/octree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "baselines/cleaver/sizing_field.hpp"
#include "baselines/cleaver/testing_lattice.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(Octree, CellsThatTouchDifferByOneLevel) {
  const LabelImage image = cbc3d::testing::ball_image(60, 1, 24);
  const ImageIndicators indicators(image, {1, 1, 1});
  const LatticeGrid grid = grid_over_labels(image, 1);
  const Octree octree =
      Octree::graded(grid, sizing_field(materials_of_cells(grid, indicators), {}), indicators);
  int most = 0;
  for (const Leaf& leaf : testing::all_leaves(octree)) {
    most = std::max(most, leaf.level);
    const int edge = 1 << leaf.level;
    for (int n = 0; n < 27; ++n) {
      const Index3 step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      Index3 beyond{};
      for (std::size_t a = 0; a < 3; ++a)
        beyond[a] = leaf.cell[a] + (step[a] < 0 ? -1 : step[a] > 0 ? edge : edge / 2);
      ASSERT_LE(std::abs(octree.level_at(beyond) - leaf.level), 1);
    }
  }
  EXPECT_GE(most, 2);
}

TEST(Octree, DividesDownToAWantedCell) {
  LatticeGrid grid = testing::cube_grid(16, 3);
  grid.usual_level = 3;
  Octree octree = Octree::uniform(grid);
  EXPECT_EQ(octree.level_at({3, 3, 3}), 3);
  octree.divide_at({{3, 3, 3}});
  octree.balance();
  EXPECT_EQ(octree.level_at({3, 3, 3}), 0);
  EXPECT_EQ(octree.level_at({15, 15, 15}), 2);
}

TEST(Octree, LeavesAreThoseNearLabels) {
  const LabelImage image = cbc3d::testing::ball_image(60, 1, 12);
  const ImageIndicators indicators(image, {1, 1, 1});
  const Octree octree = Octree::uniform(grid_over_labels(image, 1));
  const auto leaves = octree.leaves_near_labels(indicators).size();
  EXPECT_GT(leaves, 4.0 / 3 * M_PI * 12 * 12 * 12);
  EXPECT_LT(leaves, testing::all_leaves(octree).size() / 4);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

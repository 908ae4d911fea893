#include "baselines/cleaver/lattice_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(LatticeGrid, CoversTheLabelsAndAMarginWithCornersOnVoxelCorners) {
  const LabelImage image = cbc3d::testing::ball_image(40, 1, 9);
  const LatticeGrid grid = grid_over_labels(image, 1);
  EXPECT_EQ(grid.usual_level, 0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(grid.cell_mm[axis], 1);
    EXPECT_NEAR(grid.origin_mm[axis] + 0.5, std::round(grid.origin_mm[axis] + 0.5), 1e-9);
    EXPECT_LT(grid.origin_mm[axis], 19.5 - 9 - 2);
    const auto a = static_cast<std::size_t>(axis);
    EXPECT_GT(grid.origin_mm[axis] + grid.cells[a], 19.5 + 9 + 2);
    EXPECT_EQ(grid.cells[a] % (1 << grid.top_level), 0);
  }
}

TEST(LatticeGrid, FitsTheImageWhereALabelTouchesItsBorder) {
  const LabelImage image =
      cbc3d::testing::make_image({10, 10, 7}, {1, 1, 1.3}, 1, [](const Vec3&) { return 1; });
  const LatticeGrid grid = grid_over_labels(image, 1.0);
  const double layers = 7 * 1.3 / (grid.cell_mm.z * (1 << grid.usual_level));
  EXPECT_NEAR(layers, 9, 1e-9);
}

TEST(LatticeGrid, GridCellsAreNoLargerThanAVoxel) {
  const LabelImage image = cbc3d::testing::ball_image(30, 1, 9);
  const LatticeGrid grid = grid_over_labels(image, 4);
  EXPECT_EQ(grid.usual_level, 2);
  EXPECT_EQ(grid.cell_mm, (Vec3{1, 1, 1}));
}

TEST(LatticeGrid, AnImageWithoutLabelsIsRefused) {
  const LabelImage image = cbc3d::testing::make_image({4, 4, 4}, {1, 1, 1}, 1, [](const Vec3&) { return 0; });
  EXPECT_THROW(grid_over_labels(image, 1), InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

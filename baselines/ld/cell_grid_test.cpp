#include "baselines/ld/cell_grid.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d::baselines::ld {
namespace {

TEST(CellGrid, RowsHoldTheMaterialsOfTheVoxelsThatTheCellsArePiecesOf) {
  const LabelImage image = testing::random_image({5, 4, 3}, {1, 1, 1}, 3, 1);
  const CellGrid grid(image, {.pieces = {2, 1, 3}, .margin = 1, .block = 4});
  EXPECT_EQ(grid.size(), (Index3{12, 8, 12}));
  std::vector<MaterialId> row(14);
  for (int k = -1; k <= 12; ++k) {
    for (int j = -1; j <= 8; ++j) {
      grid.read_row(-1, 13, j, k, row.data());
      for (int i = -1; i < 13; ++i) {
        const bool is_inside = i >= 1 && j >= 1 && k >= 1;
        const MaterialId expected =
            is_inside ? image.at_or_background((i - 1) / 2, j - 1, (k - 1) / 3) : kBackground;
        EXPECT_EQ(row[static_cast<std::size_t>(i + 1)], expected);
        EXPECT_EQ(grid.at(i, j, k), expected);
      }
    }
  }
}

TEST(CellGrid, TheFirstCellAfterTheMarginBeginsHalfAVoxelBeforeTheFirstCentre) {
  const LabelImage image = testing::random_image({5, 4, 3}, {1, 2, 3}, 1, 1);
  const CellGrid grid(image, {.pieces = {1, 1, 3}, .margin = 2, .block = 2});
  EXPECT_EQ(grid.cell_mm(), (Vec3{1, 2, 1}));
  EXPECT_EQ(grid.local_mm({4, 4, 4}), (Vec3{-0.5, -1, -1.5}));
  EXPECT_EQ(grid.local_mm({5, 6, 10}), (Vec3{0, 1, 1.5}));
}

TEST(CellGrid, OrientationIsExactFarFromTheOrigin) {
  constexpr int kFar = 1 << 18;
  EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orientation({0, 0, 0}, {kFar, 1, 0}, {kFar, 2, 0}, {kFar, 1, 1}), kFar);
  EXPECT_EQ(orientation({0, 0, 0}, {kFar, kFar, 1}, {kFar - 1, kFar, 0}, {1, 0, 1}), 0);
}

TEST(CellGrid, RefusesMoreCellsThanArithmeticAllows) {
  const LabelImage image = testing::random_image({5000, 1, 1}, {1, 1, 1}, 1, 1);
  EXPECT_THROW(CellGrid(image, {.pieces = {60, 1, 1}}), InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::ld

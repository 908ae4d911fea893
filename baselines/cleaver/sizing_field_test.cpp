#include "baselines/cleaver/sizing_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::baselines::cleaver {
namespace {

// A slab of so many cells between two boundaries.
CellArray<MaterialId> slab(int thickness) {
  CellArray<MaterialId> cells({64, 32, 32}, kBackground);
  for (int k = 0; k < 32; ++k) {
    for (int j = 0; j < 32; ++j) {
      for (int i = 30; i < 30 + thickness; ++i) cells.at(i, j, k) = 1;
    }
  }
  return cells;
}

TEST(SizingField, ThickerPartsHaveLargerCells) {
  const float thin = sizing_field(slab(3), {}).at(15, 8, 8);
  const float thick = sizing_field(slab(11), {}).at(15, 8, 8);
  EXPECT_GE(thin, 1);
  EXPECT_LT(thin, 2.1F);
  EXPECT_GT(thick, 2 * thin);
}

TEST(SizingField, GrowsNoFasterThanItIsTold) {
  const CellArray<float> slow = sizing_field(slab(3), {.lipschitz = 0.1});
  const CellArray<float> fast = sizing_field(slab(3), {.lipschitz = 0.4});
  EXPECT_LT(slow.at(4, 8, 8), fast.at(4, 8, 8));
  for (int i = 0; i + 1 < 15; ++i) EXPECT_LE(std::abs(slow.at(i, 8, 8) - slow.at(i + 1, 8, 8)), 2 * 0.1F * 3);
}

TEST(SizingField, ScalesWithTheFeatures) {
  const float one = sizing_field(slab(5), {}).at(15, 8, 8);
  EXPECT_FLOAT_EQ(sizing_field(slab(5), {.feature_scaling = 3}).at(15, 8, 8), 3 * one);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

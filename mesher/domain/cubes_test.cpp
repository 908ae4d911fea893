// Cubes that space is cut in.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>

#include "mesher/domain/cubes.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

TEST(Cubes, KeysAreDistinctAndConsecutiveAlongX) {
  std::set<std::uint64_t> keys;
  for (int k = -3; k <= 3; ++k) {
    for (int j = -3; j <= 3; ++j) {
      for (int i = -3; i <= 3; ++i) {
        EXPECT_TRUE(keys.insert(CubeKeys::key({i, j, k})).second);
        EXPECT_EQ(CubeKeys::key({i + 1, j, k}), CubeKeys::key({i, j, k}) + 1);
      }
    }
  }
}

TEST(Cubes, ACubeHoldsItsPlaces) {
  const CubeKeys cubes{0.7};
  std::mt19937 random(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 x = testing::draw_point(random, -9, 9);
    const Index3 cube = cubes.cube_of(x);
    for (int axis = 0; axis < 3; ++axis) {
      const double low = 0.7 * cube[static_cast<std::size_t>(axis)];
      EXPECT_GE(x[axis], low - 1e-12);
      EXPECT_LT(x[axis], low + 0.7 + 1e-12);
    }
  }
}

TEST(Cubes, ThoseOfAnImageAreNumberedOnceAndHoldWhatIsOutside) {
  ImageFrame frame;
  frame.size = {10, 7, 5};
  frame.spacing_mm = {1, 0.5, 2};
  const ImageCubes cubes(frame, 1.5);
  std::set<std::size_t> numbers;
  for (int k = 0; k < cubes.grid.size[2]; ++k) {
    for (int j = 0; j < cubes.grid.size[1]; ++j) {
      for (int i = 0; i < cubes.grid.size[0]; ++i) numbers.insert(cubes.number({i, j, k}));
    }
  }
  EXPECT_EQ(numbers.size(), cubes.count());
  EXPECT_EQ(*numbers.rbegin(), cubes.count() - 1);
  EXPECT_EQ(cubes.cube_of({-50, -1, -0.1}), (Index3{0, 0, 0}));
  const Index3 last = {cubes.grid.size[0] - 1, cubes.grid.size[1] - 1, cubes.grid.size[2] - 1};
  EXPECT_EQ(cubes.cube_of({99, 99, 99}), last);
  EXPECT_EQ(cubes.cube_of({3.1, 1.4, 4.6}), (Index3{2, 0, 3}));
}

}  // namespace
}  // namespace cbc3d

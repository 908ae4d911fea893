#include "metrics/thin_voxels.hpp"

#include <gtest/gtest.h>

#include <random>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

LabelImage plate(int thickness) {
  LabelImage image = test::empty_image({20, 20, 20}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {3, 3, 8}, {16, 16, 8 + thickness - 1}, 1);
  return image;
}

TEST(ThinVoxels, PlatesOfOneAndTwoVoxels) {
  EXPECT_TRUE(is_thin_near(plate(1), {10, 10, 8}, 1, false));
  EXPECT_TRUE(is_thin_near(plate(2), {10, 10, 8}, 1, false));
  EXPECT_FALSE(is_thin_near(plate(3), {10, 10, 8}, 1, false));
  EXPECT_FALSE(is_thin_near(plate(1), {10, 10, 8}, 1, true));
  EXPECT_TRUE(is_thin_near(plate(1), {10, 10, 8 + kThinReach}, 1, false));
  EXPECT_FALSE(is_thin_near(plate(1), {10, 10, 8 + kThinReach + 1}, 1, false));
}

TEST(ThinVoxels, SlitInALabel) {
  LabelImage image = test::empty_image({20, 20, 20}, {1, 1, 1}, {0, 1, 2});
  test::fill_box(image, {2, 2, 2}, {17, 17, 17}, 1);
  test::fill_box(image, {2, 2, 9}, {17, 17, 10}, 2);
  EXPECT_TRUE(is_thin_near(image, {10, 10, 9}, 1, true));
  EXPECT_FALSE(is_thin_near(image, {10, 10, 9}, 1, false));
  EXPECT_TRUE(is_thin_near(image, {10, 10, 9}, 2, false));
  EXPECT_FALSE(is_thin_near(image, {10, 10, 5}, 1, true));
}

TEST(ThinVoxels, CornersOfABoxAreNotThin) {
  LabelImage image = test::empty_image({20, 20, 20}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {5, 5, 5}, {12, 12, 12}, 1);
  for (const Index3& corner : {Index3{5, 5, 5}, Index3{12, 5, 5}, Index3{12, 12, 12}}) {
    EXPECT_FALSE(is_thin_near(image, corner, 1, false));
    EXPECT_FALSE(is_thin_near(image, corner, 1, true));
  }
}

TEST(ThinVoxels, ObliqueHalfSpacesAreNotThin) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    LabelImage image = test::empty_image({24, 24, 24}, {1, 1, 1}, {0, 1});
    const Vec3 n = Vec3{normal(random), normal(random), normal(random)}.normalized();
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      image.voxels[v] = n.dot(Vec3{at[0] - 11.5, at[1] - 11.5, at[2] - 11.5}) < .3 ? 1 : 0;
    }
    EXPECT_FALSE(is_thin_near(image, {12, 12, 12}, 1, false)) << trial;
    EXPECT_FALSE(is_thin_near(image, {12, 12, 12}, 1, true)) << trial;
  }
}

TEST(ThinVoxels, OutsideOfTheImageIsNotTheLabel) {
  LabelImage image = test::empty_image({10, 10, 2}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {0, 0, 0}, {9, 9, 1}, 1);
  EXPECT_TRUE(is_thin_near(image, {5, 5, 0}, 1, false));
  EXPECT_FALSE(is_thin_near(image, {5, 5, 0}, 1, true));
  EXPECT_FALSE(is_thin_near(image, {50, 50, 50}, 1, false));
}

}  // namespace
}  // namespace cbc3d::metrics

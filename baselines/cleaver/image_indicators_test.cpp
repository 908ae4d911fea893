#include "baselines/cleaver/image_indicators.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

using cbc3d::testing::make_image;

LabelImage half_spaces() {
  return make_image({16, 12, 12}, {1, 0.5, 2}, 2, [](const Vec3& p) { return p.x < 7.5 ? 1 : 2; });
}

TEST(ImageIndicators, AFlatBoundaryLiesBetweenTheVoxels) {
  const LabelImage image = half_spaces();
  const ImageIndicators indicators(image, {1, 1, 1});
  EXPECT_EQ(indicators.material_at({7.4, 2, 10}), 1);
  EXPECT_EQ(indicators.material_at({7.6, 2, 10}), 2);
  EXPECT_NEAR(indicators.crossing({7, 2, 10}, {8, 2, 10}, 1, 2), 0.5, 0.01);
  EXPECT_NEAR(indicators.crossing({8.2, 2, 10}, {7.2, 2, 10}, 2, 1), 0.7, 0.01);
  // Far from the boundary all is the one or the other.
  EXPECT_NEAR(indicators.crossing({0, 1, 5}, {15, 4, 15}, 1, 2), 0.5, 0.01);
}

TEST(ImageIndicators, TheExteriorBeginsOnTheBox) {
  const LabelImage image = half_spaces();
  const ImageIndicators indicators(image, {1, 1, 1});
  EXPECT_EQ(indicators.low(), (Vec3{-0.5, -0.25, -1}));
  EXPECT_EQ(indicators.high(), (Vec3{15.5, 5.75, 23}));
  EXPECT_EQ(indicators.material_at({-0.4, 2, 10}), 1);
  EXPECT_EQ(indicators.material_at({-0.6, 2, 10}), kBackground);
  EXPECT_TRUE(indicators.is_outside({3, 5.8, 4}));
  EXPECT_DOUBLE_EQ(indicators.crossing({0.5, 2, 10}, {-1.5, 2, 10}, 1, kBackground), 0.5);
  EXPECT_DOUBLE_EQ(indicators.crossing({-1.5, 2, 10}, {0.5, 2, 10}, kBackground, 1), 0.5);
}

TEST(ImageIndicators, ALabelThatTheBlurErasesIsTakenFromItsVoxels) {
  LabelImage image = make_image({20, 20, 20}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 10 ? 1 : 0; });
  image.voxels[image.frame.offset(15, 8, 9)] = 2;
  const ImageIndicators indicators(image, {1, 1, 1});
  EXPECT_EQ(indicators.sharp_materials(), std::vector<MaterialId>{2});
  EXPECT_EQ(indicators.material_at({15, 8, 9}), 2);
  EXPECT_EQ(indicators.material_at({15.6, 8, 9}), kBackground);
  EXPECT_NEAR(indicators.crossing({15, 8, 9}, {16, 8, 9}, 2, kBackground), 0.5, 0.01);
}

TEST(ImageIndicators, BackgroundIsSureOnlyAwayFromLabels) {
  const LabelImage image =
      make_image({64, 32, 32}, {1, 1, 1}, 1, [](const Vec3& p) { return p.x < 10 ? 1 : 0; });
  const ImageIndicators indicators(image, {1, 1, 1});
  EXPECT_TRUE(indicators.is_surely_background({40, 5, 5}, {60, 20, 20}));
  EXPECT_TRUE(indicators.is_surely_background({100, 5, 5}, {110, 20, 20}));
  EXPECT_FALSE(indicators.is_surely_background({8, 5, 5}, {60, 20, 20}));
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

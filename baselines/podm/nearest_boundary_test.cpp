#include "baselines/podm/nearest_boundary.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesher/core/error.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::podm {
namespace {

Vec3 centre(const LabelImage& image, const Index3& v) {
  return image.frame.local_centre(v[0], v[1], v[2]);
}

double brute_force_mm2(const LabelImage& image, const Vec3& place) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    if (is_boundary_voxel(image, at[0], at[1], at[2]))
      best = std::min(best, (centre(image, at) - place).squared_norm());
  }
  return best;
}

void expect_exact(const LabelImage& image) {
  const NearestBoundary boundary(image);
  ASSERT_TRUE(boundary.has_boundary());
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    bool in_box = true;
    for (std::size_t a = 0; a < 3; ++a)
      in_box = in_box && at[a] >= boundary.first()[a] && at[a] <= boundary.last()[a];
    if (!in_box) {
      EXPECT_EQ(image.voxels[v], kBackground);
      continue;
    }
    const Index3 found = boundary.nearest(at);
    EXPECT_NE(boundary.faces(found), 0);
    EXPECT_NEAR((centre(image, found) - centre(image, at)).squared_norm(),
                brute_force_mm2(image, centre(image, at)), 1e-9);
  }
}

TEST(NearestBoundary, IsThatOfBruteForceOnSparseNoise) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    LabelImage image = cbc3d::testing::noise_image(11, 0.004, seed);
    image.voxels[image.frame.offset(3, 4, 5)] = 1;
    image.frame.spacing_mm = {0.7, 1.9, 1.1};
    expect_exact(image);
  }
}

TEST(NearestBoundary, IsThatOfBruteForceAroundABall) {
  LabelImage image = cbc3d::testing::ball_image(14, 1, 4.5, 2);
  image.frame.spacing_mm = {1, 0.5, 2.5};
  expect_exact(image);
}

TEST(NearestBoundary, FacesAreThoseToOtherMaterialsAndToTheOutside) {
  LabelImage image = cbc3d::testing::make_image({3, 1, 1}, {1, 1, 1}, 2, [](const Vec3&) { return 1; });
  image.voxels[2] = 2;
  const NearestBoundary boundary(image);
  EXPECT_EQ(boundary.faces({0, 0, 0}), 0b111101);
  EXPECT_EQ(boundary.faces({1, 0, 0}), 0b111110);
}

TEST(NearestBoundary, TheBoxIsThatOfTheLabelsWithAMarginInTheImage) {
  LabelImage image = cbc3d::testing::noise_image(12, 0, 1);
  image.voxels[image.frame.offset(0, 4, 6)] = 1;
  image.voxels[image.frame.offset(2, 7, 6)] = 2;
  const NearestBoundary boundary(image);
  EXPECT_EQ(boundary.first(), (Index3{0, 3, 5}));
  EXPECT_EQ(boundary.last(), (Index3{3, 8, 7}));
}

TEST(NearestBoundary, AnImageWithoutLabelsHasNone) {
  EXPECT_FALSE(NearestBoundary(cbc3d::testing::noise_image(5, 0, 1)).has_boundary());
}

TEST(NearestBoundary, RefusesAnAxisThatItsNumbersCannotCount) {
  LabelImage image;
  image.frame.size = {65535, 1, 1};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  EXPECT_THROW(NearestBoundary{image}, InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::podm

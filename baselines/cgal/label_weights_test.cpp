#include "baselines/cgal/label_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::baselines {
namespace {

LabelImage blank(const Index3& size, const Vec3& spacing_mm) {
  LabelImage image;
  image.frame.size = size;
  image.frame.spacing_mm = spacing_mm;
  image.labels = {0, 1, 2};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  return image;
}

TEST(LabelWeights, FallToOneHalfAcrossAPlaneAlongEveryAxis) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LabelImage image = blank({40, 40, 40}, {1, 0.5, 2});
    for (std::size_t v = 0; v < image.voxels.size(); ++v)
      image.voxels[v] = image.frame.index_of(v)[axis] < 20 ? 1 : 2;
    const double sigma_mm = 2;
    const auto weights = label_weights(image, 1, sigma_mm);
    ASSERT_EQ(weights.size(), 42U * 42U * 42U);
    for (int n = 12; n < 20; ++n) {
      Index3 at{21, 21, 21};
      at[axis] = n + 1;
      const int v = (at[2] * 42 + at[1]) * 42 + at[0];
      // The plane lies between the voxels 19 and 20; the blurred step is the normal distribution.
      const double distance_mm = (19.5 - n) * image.frame.spacing_mm[static_cast<int>(axis)];
      const double truth = 0.5 * (1 + std::erf(distance_mm / sigma_mm / std::sqrt(2.0)));
      EXPECT_NEAR(weights[static_cast<std::size_t>(v)] / 255.0, truth, 0.02)
          << "axis " << axis << ", voxel " << n;
    }
  }
}

TEST(LabelWeights, BackgroundCountsAsALabel) {
  LabelImage image = blank({9, 9, 9}, {1, 1, 1});
  image.voxels[image.frame.offset(4, 4, 4)] = 1;
  const auto weights = label_weights(image, 2, 1);
  const auto at = [&](std::size_t i) { return weights[(6 * 13 + 6) * 13 + i]; };
  const double peak = std::pow(2 * M_PI, -1.5);
  EXPECT_NEAR(at(6) / 255.0, 1 - peak, 0.01);  // the one voxel keeps less than the background around it
  EXPECT_EQ(at(0), 255);
  EXPECT_EQ(at(12), 255);
}

TEST(LabelWeights, AnEmptyImageHasFullWeights) {
  for (const std::uint8_t weight : label_weights(blank({3, 4, 5}, {1, 1, 1}), 1, 1)) EXPECT_EQ(weight, 255);
}

}  // namespace
}  // namespace cbc3d::baselines

// What an image says of places, against searches through all its voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "mesher/core/label_image.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(LabelImage, NearestBoundaryVoxelIsThatOfAFullSearch) {
  std::mt19937 random(3);
  const LabelImage image = testing::make_image({9, 8, 7}, {1, 0.7, 1.6}, 4, [&](const Vec3&) {
    return random() % 3 == 0 ? static_cast<int>(random() % 4) : 1;
  });
  int found = 0;
  for (int n = 0; n < 400; ++n) {
    const auto draw = [&](double size) { return size * 1.2 * (random() / 4294967296.0) - 1; };
    const Vec3 at = {draw(9 * image.frame.spacing_mm.x), draw(8 * image.frame.spacing_mm.y),
                     draw(7 * image.frame.spacing_mm.z)};
    const auto m = static_cast<MaterialId>(n % 4);
    const double reach = 0.3 + 0.01 * n;
    double least = reach * reach;
    bool any = false;
    for (int k = 0; k < 7; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 9; ++i) {
          const auto beside = [&](int di, int dj, int dk) {
            return image.at_or_background(i + di, j + dj, k + dk);
          };
          const std::array<MaterialId, 6> around = {beside(1, 0, 0),  beside(-1, 0, 0), beside(0, 1, 0),
                                                    beside(0, -1, 0), beside(0, 0, 1),  beside(0, 0, -1)};
          const MaterialId own = image.at(i, j, k);
          const bool counts = m == kBackground ? own != kBackground &&
                                                     std::count(around.begin(), around.end(), kBackground) > 0
                                               : own == m && std::count(around.begin(), around.end(), m) < 6;
          const double d = (image.frame.local_centre(i, j, k) - at).squared_norm();
          if (counts && d <= least) {
            least = d;
            any = true;
          }
        }
      }
    }
    const auto got = nearest_boundary_voxel(image, at, m, reach);
    ASSERT_EQ(got.has_value(), any);
    EXPECT_EQ(has_boundary_voxel_near(image, at, m, reach), any);
    if (any) {
      EXPECT_NEAR((*got - at).squared_norm(), least, 1e-12);
    }
    found += any ? 1 : 0;
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 390);
}

}  // namespace
}  // namespace cbc3d

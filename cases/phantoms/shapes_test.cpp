#include "cases/phantoms/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::cases {
namespace {

double volume_mm3(const LabelImage& image) {
  const Vec3& s = image.frame.spacing_mm;
  return static_cast<double>(image.voxels_per_material()[1]) * s.x * s.y * s.z;
}

TEST(Shapes, BoxAndBallHaveTheirVolumes) {
  EXPECT_EQ(volume_mm3(box_image({8, 9, 10}, {1, 2, 3}, {1, 1, 1}, {3, 4, 5})), 3 * 4 * 5 * 6.0);
  const double ball = 4 * M_PI / 3 * 8 * 8 * 8;
  EXPECT_NEAR(volume_mm3(ball_image({40, 40, 20}, {.5, .5, 1}, 8)), ball, .02 * ball);
}

}  // namespace
}  // namespace cbc3d::cases

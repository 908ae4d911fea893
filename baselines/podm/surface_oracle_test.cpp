#include "baselines/podm/surface_oracle.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::podm {
namespace {

constexpr double kRadius = 11.3;

LabelImage ball() {
  return cbc3d::testing::ball_image(32, 1, kRadius);
}

Vec3 random_place(std::mt19937& random, double low, double high) {
  const auto draw = [&] { return low + (high - low) * (random() / 4294967296.0); };
  const double x = draw(), y = draw();
  return {x, y, draw()};
}

// The nearest place of the voxels' faces by brute force.
double distance_to_faces(const LabelImage& image, const Vec3& place) {
  double best = 1e300;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    for (int axis = 0; axis < 3; ++axis) {
      Index3 next = at;
      ++next[static_cast<std::size_t>(axis)];
      if (image.at_or_background(at[0], at[1], at[2]) == image.at_or_background(next[0], next[1], next[2]))
        continue;
      const Vec3 c = image.frame.local_centre(at[0], at[1], at[2]);
      const Vec3& h = image.frame.spacing_mm;
      Vec3 q;
      for (int a = 0; a < 3; ++a) q[a] = std::min(std::max(place[a], c[a] - h[a] / 2), c[a] + h[a] / 2);
      q[axis] = c[axis] + h[axis] / 2;
      best = std::min(best, (q - place).norm());
    }
  }
  return best;
}

TEST(SurfaceOracle, OfVoxelsIsOnTheirFacesAndNearlyTheNearest) {
  LabelImage image = ball();
  image.frame.spacing_mm = {1, 0.6, 1.4};
  const SurfaceOracle oracle(image, false);
  std::mt19937 random(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 place = random_place(random, -5, 40);
    const Vec3 found = oracle.nearest(place).value();
    EXPECT_LT(distance_to_faces(image, found), 1e-9);
    const double truth = distance_to_faces(image, place);
    EXPECT_LE((found - place).norm(), truth + image.frame.voxel_diagonal_mm());
    EXPECT_LE(oracle.distance_bound_mm(place), truth);
    EXPECT_EQ(oracle.material_at(place), image.at_local(place));
  }
}

TEST(SurfaceOracle, SmoothBoundaryOfABallIsWithinAFewHundredthsOfAVoxelOnAverage) {
  const LabelImage image = ball();
  const SurfaceOracle oracle(image, true);
  const Vec3 centre = cbc3d::testing::centre_of(image);
  std::mt19937 random(5);
  double sum = 0, largest = 0;
  const int count = 300;
  for (int n = 0; n < count; ++n) {
    const Vec3 place = random_place(random, 0, 31);
    const Vec3 found = oracle.nearest(place).value();
    const double error = std::abs((found - centre).norm() - kRadius);
    sum += error;
    largest = std::max(largest, error);
    EXPECT_LE(oracle.distance_bound_mm(place), std::abs((place - centre).norm() - kRadius) + 0.3);
  }
  EXPECT_LT(sum / count, 0.15);
  EXPECT_LT(largest, 0.5);
}

TEST(SurfaceOracle, CrossingIsTheFirstChangeAlongTheSegment) {
  const LabelImage image = ball();
  const Vec3 centre = cbc3d::testing::centre_of(image);
  for (const bool smooth : {false, true}) {
    const SurfaceOracle oracle(image, smooth);
    std::mt19937 random(11);
    for (int n = 0; n < 200; ++n) {
      const Vec3 outside = centre + 100 * (random_place(random, -1, 1).normalized());
      const auto found = oracle.crossing(outside, centre);
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR((found.value() - centre).norm(), kRadius, 0.9);
      // On the segment, up to the voxel's exact face.
      EXPECT_LT((found.value() - centre).cross((outside - centre).normalized()).norm(), 1e-5);
    }
    EXPECT_FALSE(oracle.crossing(centre, centre + Vec3{3, 2, 1}));
    EXPECT_FALSE(oracle.crossing({-50, 0, 0}, {-50, 30, 30}));
    EXPECT_FALSE(oracle.crossing({-50, -40, 0}, {200, -40, 10}));
  }
}

TEST(SurfaceOracle, CrossingsOfAFlatSideAreExactlyCoplanar) {
  const LabelImage image = cbc3d::testing::make_image({9, 9, 9}, {0.7, 0.7, 1.3}, 1,
                                                      [](const Vec3& p) { return p.z > 4 ? 1 : 0; });
  const SurfaceOracle oracle(image, false);
  std::mt19937 random(1);
  for (int n = 0; n < 50; ++n) {
    const Vec3 from = random_place(random, 1, 3), to = from + Vec3{0.3, -0.2, 4};
    EXPECT_EQ(oracle.crossing(from, to).value().z, 3.5 * 1.3);
    EXPECT_EQ(oracle.nearest({from.x, from.y, 4.0 + 0.1 * from.z}).value().z, 3.5 * 1.3);
  }
}

}  // namespace
}  // namespace cbc3d::baselines::podm

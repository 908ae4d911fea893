#include "metrics/nearest_voxel.hpp"

#include <gtest/gtest.h>

namespace cbc3d::metrics {
namespace {

TEST(NearestVoxel, RoundsToTheNearestCentreAndStaysNearTheImage) {
  ImageFrame frame;
  frame.size = {4, 5, 6};
  frame.spacing_mm = {1, 2, 0.5};
  EXPECT_EQ(nearest_voxel(frame, {1.4, 5.2, 1.3}), (Index3{1, 3, 3}));
  EXPECT_EQ(nearest_voxel(frame, {-0.4, 8.9, 2.6}), (Index3{0, 4, 5}));
  EXPECT_EQ(nearest_voxel(frame, {-0.6, 9.1, 2.8}), (Index3{-1, 5, 6}));
  EXPECT_EQ(nearest_voxel(frame, {-1e300, 1e300, 1e18}), (Index3{-10, 15, 16}));
}

}  // namespace
}  // namespace cbc3d::metrics

#include "cases/phantoms/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cbc3d::cases {
namespace {

PhantomModel block_in_ball() {
  PhantomModel model;
  model.label_count = 2;
  model.layers.push_back(predicate_layer(1, [](const Vec3& at) { return (at - Vec3{5, 5, 5}).norm() < 4; }));
  model.layers.push_back(predicate_layer(2, [](const Vec3& at) { return at.x > 5 && at.x < 7; }));
  return model;
}

TEST(PaintSlab, LaterLayersArePaintedOverEarlierOnesAndSlabsAreTheWhole) {
  ImageFrame frame;
  frame.size = {11, 11, 11};
  const PhantomModel model = block_in_ball();
  const std::size_t slice = 11 * 11;
  std::vector<PaintedVoxel> whole(11 * slice), slabs(11 * slice);
  paint_slab(model, frame, 0, 11, whole.data());
  for (int k = 0; k < 11; k += 2) {
    paint_slab(model, frame, k, std::min(11, k + 2), slabs.data() + static_cast<std::size_t>(k) * slice);
  }
  EXPECT_EQ(whole, slabs);
  EXPECT_EQ(whole[frame.offset(6, 5, 5)], 2);
  EXPECT_EQ(whole[frame.offset(4, 5, 5)], 1);
  EXPECT_EQ(whole[frame.offset(0, 0, 0)], 0);
}

TEST(SignedDistance, OfAPredicateIsNotKnown) {
  EXPECT_TRUE(std::isnan(signed_distance_mm(block_in_ball(), {5, 5, 5}, 1)));
}

}  // namespace
}  // namespace cbc3d::cases

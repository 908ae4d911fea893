#include "metrics/voxel_components.hpp"

#include <gtest/gtest.h>

#include <random>

#include "metrics/image_topology.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

VoxelBox padded(VoxelBox box) {
  for (std::size_t axis = 0; axis < 3; ++axis) --box.low[axis], ++box.high[axis];
  return box;
}

TEST(VoxelComponents, VoxelsThatTouchAtACorner) {
  LabelImage image = test::empty_image({6, 6, 6}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {1, 1, 1}, {2, 2, 2}, 1);
  image.voxels[image.frame.offset(3, 3, 3)] = 1;
  const VoxelBox box = boxes_of_materials(image)[1];
  EXPECT_EQ(box.low, (Index3{1, 1, 1}));
  EXPECT_EQ(box.high, (Index3{3, 3, 3}));
  const VoxelComponents open(image, {1, false, false}, box), closed(image, {1, false, true}, box);
  ASSERT_EQ(open.components().size(), 2U);
  ASSERT_EQ(closed.components().size(), 1U);
  EXPECT_EQ(open.components()[0].voxels, 8);
  EXPECT_EQ(open.components()[1].place, (Index3{3, 3, 3}));
  EXPECT_EQ(open.find({3, 3, 3}), std::optional(1U));
  EXPECT_FALSE(open.find({3, 3, 2}));
  EXPECT_FALSE(open.find({5, 5, 5}));
}

TEST(VoxelComponents, CavityAndOutside) {
  LabelImage image = test::empty_image({7, 7, 7}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {0, 0, 0}, {6, 6, 6}, 1);
  image.voxels[image.frame.offset(4, 3, 2)] = 0;
  const VoxelComponents rest(image, {1, true, false}, padded(boxes_of_materials(image)[1]));
  ASSERT_EQ(rest.components().size(), 2U);
  EXPECT_TRUE(rest.components()[0].reaches_border);
  EXPECT_FALSE(rest.components()[1].reaches_border);
  EXPECT_EQ(rest.components()[1].place, (Index3{4, 3, 2}));
}

TEST(VoxelComponents, AgreeWithTheBettiNumbersOfRandomImages) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    LabelImage image = test::empty_image({9, 8, 7}, {1, 1, 1}, {0, 1, 2});
    for (std::size_t v = 0; v < image.voxels.size(); ++v)
      image.voxels[v] = static_cast<MaterialId>(random() % 3);
    const ImageTopology topology = image_topology(image);
    const std::vector<VoxelBox> boxes = boxes_of_materials(image);
    for (const MaterialId m : {MaterialId{1}, MaterialId{2}}) {
      const auto count = [&](bool complement, bool at_corners) {
        const VoxelComponents found(image, {m, complement, at_corners},
                                    complement ? padded(boxes[m]) : boxes[m]);
        return static_cast<std::int64_t>(found.components().size());
      };
      EXPECT_EQ(count(false, true), topology.per_material[m].closed.b[0]);
      EXPECT_EQ(count(true, false) - 1, topology.per_material[m].closed.b[2]);
      EXPECT_EQ(count(false, false), topology.per_material[m].open.b[0]);
      EXPECT_EQ(count(true, true) - 1, topology.per_material[m].open.b[2]);
    }
  }
}

}  // namespace
}  // namespace cbc3d::metrics

#include "cases/derive.hpp"

#include <gtest/gtest.h>

#include "cases/testing_two_blocks.hpp"

namespace cbc3d::cases {
namespace {

using test::clear;
using test::two_blocks;

TEST(FillHoles, TakesTheLabelOfMostFacesAround) {
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});  // within label 1
  clear(image, {9, 4, 4});  // within label 2
  clear(image, {9, 5, 4});
  clear(image, {7, 7, 5});  // five faces of label 2, one of label 1
  clear(image, {6, 9, 5});  // two voxels across the interface: five faces of each label
  clear(image, {7, 9, 5});
  EXPECT_EQ(fill_holes(image), 6U);
  LabelImage expected = two_blocks();
  expected.voxels[expected.frame.offset(7, 9, 5)] = 1;
  EXPECT_EQ(image.voxels, expected.voxels);
  EXPECT_EQ(fill_holes(image), 0U);
}

TEST(FillHoles, OpenRegionsStay) {
  LabelImage image = two_blocks();
  clear(image, {2, 5, 5});  // a dent
  clear(image, {4, 6, 2});  // a shaft
  clear(image, {4, 6, 3});
  const auto before = image.voxels;
  EXPECT_EQ(fill_holes(image), 0U);
  EXPECT_EQ(image.voxels, before);
  clear(image, {3, 6, 4});  // touches the shaft by an edge only: enclosed by faces
  EXPECT_EQ(fill_holes(image), 1U);
  EXPECT_EQ(image.voxels, before);
}

TEST(FillHoles, RegionsAtTheImageBorderStay) {
  LabelImage image = box_image({9, 9, 9}, {1, 1, 1}, {0, 0, 0}, {8, 8, 8});
  clear(image, {0, 4, 4});
  clear(image, {1, 4, 4});
  EXPECT_EQ(fill_holes(image), 0U);
  clear(image, {4, 4, 4});
  EXPECT_EQ(fill_holes(image), 1U);
}

TEST(Repeated, CopiesLieSideBySide) {
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});
  image.frame.origin_mm = {5, -3, 2};
  const LabelImage many = repeated(image, {3, 1, 2});
  EXPECT_EQ(many.frame.size, (Index3{48, 14, 24}));
  EXPECT_EQ(many.frame.origin_mm, image.frame.origin_mm);
  EXPECT_EQ(many.labels, image.labels);
  for (std::size_t v = 0; v < many.voxels.size(); ++v) {
    const Index3 at = many.frame.index_of(v);
    ASSERT_EQ(many.voxels[v], image.at(at[0] % 16, at[1], at[2] % 12));
  }
  EXPECT_EQ(repeated(image, {1, 1, 1}).voxels, image.voxels);
}

}  // namespace
}  // namespace cbc3d::cases

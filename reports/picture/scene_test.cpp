// What is drawn needs an X server; where it is looked from does not.
#include "reports/picture/scene.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

LabelImage image_with(const std::vector<Index3>& labelled) {
  LabelImage image;
  image.frame.size = {10, 8, 6};
  image.frame.spacing_mm = {1, 2, 3};
  image.frame.origin_mm = {100, 200, 300};
  image.labels = {0, 4};
  image.voxels.assign(image.frame.voxel_count(), 0);
  for (const Index3& at : labelled) {
    image.voxels[image.frame.offset(at[0], at[1], at[2])] = 1;
  }
  return image;
}

void expect_near(const Vec3& found, const Vec3& expected) {
  EXPECT_LT((found - expected).norm(), 1e-12) << found.x << ' ' << found.y << ' ' << found.z;
}

TEST(Scene, TheViewIsOfTheLabelledVoxelsWhole) {
  const View view = view_of(image_with({{2, 1, 1}, {5, 6, 2}}));
  expect_near(view.centre_mm, {103.5, 207, 304.5});
  expect_near(view.extent_mm, {4, 12, 6});
}

TEST(Scene, OneVoxelIsAsLargeAsItsSpacing) {
  const View view = view_of(image_with({{9, 0, 5}}));
  expect_near(view.centre_mm, {109, 200, 315});
  expect_near(view.extent_mm, {1, 2, 3});
}

TEST(Scene, TheViewTurnsWithTheImage) {
  LabelImage image = image_with({{2, 1, 1}});
  // The image's axes are physical y, -x and z.
  image.frame.direction = Mat3::from_columns({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  const View view = view_of(image);
  expect_near(view.centre_mm, {98, 202, 303});
  expect_near(view.axes.column(0), {0, 1, 0});
  expect_near(view.axes.column(1), {-1, 0, 0});
  expect_near(view.extent_mm, {1, 2, 3});
}

}  // namespace
}  // namespace cbc3d::reports

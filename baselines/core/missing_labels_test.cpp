#include "baselines/core/missing_labels.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines {
namespace {

LabelImage image_of(const std::vector<MaterialId>& voxels, MaterialId materials) {
  LabelImage image;
  image.frame.size = {static_cast<int>(voxels.size()), 1, 1};
  for (MaterialId m = 1; m <= materials; ++m) image.labels.push_back(10 * m);
  image.voxels.assign(voxels.size(), kBackground);
  for (std::size_t v = 0; v < voxels.size(); ++v) image.voxels[v] = voxels[v];
  return image;
}

TEST(MissingLabels, AreThoseThatHaveVoxelsAndWereNotFound) {
  const LabelImage image = image_of({0, 1, 2, 4, 4}, 4);
  EXPECT_EQ(missing_materials(image, {1}), (std::vector<MaterialId>{2, 4}));
  EXPECT_TRUE(missing_materials(image, {0, 4, 2, 1, 1}).empty());
}

TEST(MissingLabels, AreNamedByTheirValuesTheFirstTen) {
  const LabelImage image = image_of({0}, 12);
  EXPECT_EQ(names_of(image, {3}), "label 30");
  EXPECT_EQ(names_of(image, {3, 5}), "labels 30, 50");
  EXPECT_EQ(names_of(image, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}),
            "labels 10, 20, 30, 40, 50, 60, 70, 80, 90, 100 and 2 more");
}

}  // namespace
}  // namespace cbc3d::baselines

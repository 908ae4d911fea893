#include "mesher/core/grey_check.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cbc3d {
namespace {

/// An image of cubes of `side` voxels, each with a label of its own.
LabelImage cubes(int count, int side) {
  LabelImage image;
  image.frame.size = {count * side, count * side, count * side};
  for (int n = 1; n <= count * count * count; ++n) {
    image.labels.push_back(n);
  }
  image.voxels.resize(image.frame.voxel_count());
  image.voxels.hold(image.labels.size());
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels.set(
        v, static_cast<MaterialId>(1 + at[0] / side + count * (at[1] / side + count * (at[2] / side))));
  }
  return image;
}

TEST(GreyCheck, CountsVoxelsThatStandAlone) {
  const LabelTexture apart = texture_of(cubes(4, 1));
  EXPECT_EQ(apart.labels, 64U);
  EXPECT_EQ(apart.single_voxels, 64U);
  EXPECT_EQ(apart.unlike_faces, apart.faces);
  EXPECT_EQ(apart.faces, 3U * 3 * 16);
  const LabelTexture together = texture_of(cubes(2, 4));
  EXPECT_EQ(together.single_voxels, 0U);
  EXPECT_EQ(together.unlike_faces, 3U * 64);
}

TEST(GreyCheck, AtlasesAreNoneAndNoiseIs) {
  EXPECT_EQ(why_grey(cubes(9, 4)), "");  // 729 labels
  LabelImage noise = cubes(4, 4);
  std::mt19937 random(3);
  for (std::size_t v = 0; v < noise.voxels.size(); ++v) {
    noise.voxels.set(v, static_cast<MaterialId>(random() % noise.labels.size()));
  }
  EXPECT_NE(why_grey(noise).find("64 labels"), std::string::npos);
  EXPECT_EQ(why_grey(cubes(3, 1)), "");  // 27 labels are few enough to be meant
}

TEST(GreyCheck, NoiseOfFewLabelsIsNamedWhereItIsLarge) {
  for (const int labels : {2, 3, 20}) {
    for (const int size : {10, 40, 100}) {
      LabelImage image;
      image.frame.size = {size, size, size};
      for (int n = 1; n < labels; ++n) {
        image.labels.push_back(n);
      }
      image.voxels.resize(image.frame.voxel_count());
      for (std::size_t v = 0; v < image.voxels.size(); ++v) {
        const Index3 at = image.frame.index_of(v);
        image.voxels.set(v, static_cast<MaterialId>((at[0] + at[1] + at[2]) % labels));
      }
      EXPECT_EQ(why_grey(image).find("noise") != std::string::npos, size > 10) << labels << ' ' << size;
    }
  }
  EXPECT_EQ(why_grey(cubes(3, 20)), "");
}

}  // namespace
}  // namespace cbc3d

#include "mesher/preprocess/grey_check.hpp"

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

/// `size`^3 voxels of label `value(voxel)`, which is below `labels`.
template <typename Value>
LabelImage filled(int size, int labels, const Value& value) {
  LabelImage image;
  image.frame.size = {size, size, size};
  for (int n = 1; n < labels; ++n) {
    image.labels.push_back(n);
  }
  image.voxels.resize(image.frame.voxel_count());
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    image.voxels.set(v, static_cast<MaterialId>(value(v)));
  }
  return image;
}

bool looks_like_noise(const LabelImage& image) {
  return why_grey(image).find("noise") != std::string::npos;
}

TEST(GreyCheck, NoiseOfFewLabelsIsNamedWhereItIsLarge) {
  std::mt19937 random(5);
  for (const int labels : {2, 3, 20}) {
    for (const int size : {10, 40, 100}) {
      EXPECT_EQ(looks_like_noise(filled(size, labels,
                                        [&](std::size_t v) {
                                          const auto n = static_cast<std::size_t>(size);
                                          return (v % n + v / n % n + v / n / n) %
                                                 static_cast<std::size_t>(labels);
                                        })),
                size > 10)
          << "stripes " << labels << ' ' << size;
      EXPECT_EQ(looks_like_noise(filled(
                    size, labels, [&](std::size_t) { return random() % static_cast<unsigned>(labels); })),
                size > 10)
          << "random " << labels << ' ' << size;
    }
  }
  EXPECT_EQ(why_grey(cubes(3, 20)), "");
}

TEST(GreyCheck, ThinWiresAndAFewWrongVoxelsAreNoNoise) {
  constexpr std::size_t kSize = 64;
  std::mt19937 random(5);
  // Wires one voxel wide, three apart, and a solid half of which 5 % of the voxels are wrong.
  const auto wires = [](std::size_t v) { return v % 4 == 0 && v / kSize % 4 == 0 ? 1 : 0; };
  EXPECT_EQ(why_grey(filled(kSize, 2, wires)), "");
  EXPECT_EQ(
      why_grey(filled(kSize, 2, [&](std::size_t v) { return random() % 20 == 0 ? 0 : v % kSize / 32; })), "");
}

}  // namespace
}  // namespace cbc3d

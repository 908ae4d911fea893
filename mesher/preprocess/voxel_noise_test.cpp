// Holes and specks, found and relabelled.
#include <gtest/gtest.h>

#include <tuple>

#include "mesher/preprocess/voxel_noise.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(VoxelNoise, BothTypesAreFoundAndSwitchable) {
  const auto noisy = [] {
    LabelImage image =
        testing::make_image({20, 9, 9}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 10 ? 1 : 0; });
    image.voxels[image.frame.offset(5, 4, 4)] = 0;   // hole
    image.voxels[image.frame.offset(15, 4, 4)] = 1;  // speck in background
    image.voxels[image.frame.offset(3, 2, 2)] = 2;   // speck in label 1
    return image;
  };
  for (const auto& [which, holes, specks] :
       {std::tuple{NoisyVoxels::none, 0U, 0U}, std::tuple{NoisyVoxels::holes, 1U, 0U},
        std::tuple{NoisyVoxels::specks, 0U, 2U}, std::tuple{NoisyVoxels::both, 1U, 2U}}) {
    LabelImage image = noisy();
    const NoiseReport report = relabel_noisy_voxels(image, which);
    EXPECT_EQ(report.holes_filled, holes);
    EXPECT_EQ(report.specks_relabelled, specks);
    EXPECT_EQ(image.at(5, 4, 4), holes == 1 ? 1 : 0);
    EXPECT_EQ(image.at(15, 4, 4), specks == 2 ? 0 : 1);
    EXPECT_EQ(image.at(3, 2, 2), specks == 2 ? 1 : 2);
  }
}

}  // namespace
}  // namespace cbc3d

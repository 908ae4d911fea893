// Face-connected regions, against a search from voxel to voxel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

#include "mesher/preprocess/voxel_regions.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// Number of face-connected components of labelled voxels with the same label value.
std::size_t components(const LabelImage& image) {
  std::vector<std::uint8_t> seen(image.voxels.size(), 0);
  std::size_t count = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (image.voxels[start] == 0 || seen[start] != 0) continue;
    ++count;
    std::queue<std::size_t> queue({start});
    seen[start] = 1;
    while (!queue.empty()) {
      const Index3 at = image.frame.index_of(queue.front());
      const Label label = image.labels[image.voxels[queue.front()]];
      queue.pop();
      for (int n = 0; n < 6; ++n) {
        Index3 next = at;
        next[static_cast<std::size_t>(n / 2)] += n % 2 == 0 ? -1 : 1;
        if (image.frame.contains(next[0], next[1], next[2])) {
          const std::size_t v = image.frame.offset(next[0], next[1], next[2]);
          if (seen[v] == 0 && image.voxels[v] != 0 && image.labels[image.voxels[v]] == label) {
            seen[v] = 1;
            queue.push(v);
          }
        }
      }
    }
  }
  return count;
}

TEST(VoxelRegions, AreTheFaceConnectedComponents) {
  for (const std::uint32_t seed : {4U, 5U}) {
    LabelImage image = testing::noise_image(20, 0.4, seed);
    const std::size_t expected = components(image);
    const RegionReport report = split_regions(image);
    EXPECT_EQ(report.regions, expected);
    EXPECT_EQ(image.labels.size(), 1 + expected);
    EXPECT_EQ(components(image), expected);  // labels are kept, so the components are too
  }
}

TEST(VoxelRegions, SmallOnesGoAndTheLargestStays) {
  LabelImage image = testing::make_image({50, 20, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool large = p.x < 25;                                    // 10,000 voxels
    const bool crumb = p.x > 30 && p.x < 32 && p.y < 1 && p.z < 1;  // one voxel
    const bool lone = p.x > 40 && p.x < 42 && p.y < 1 && p.z < 1;   // one voxel, all there is of label 2
    return large || crumb ? 1 : lone ? 2 : 0;
  });
  const RegionReport report = remove_small_regions(image, 2e-4);
  EXPECT_EQ(report.regions_removed, 1U);
  EXPECT_EQ(report.voxels_removed, 1U);
  EXPECT_EQ(report.voxels_before, (std::vector<std::size_t>{9998, 10001, 1}));
  EXPECT_EQ(image.voxels_per_material(), (std::vector<std::size_t>{9999, 10000, 1}));
  EXPECT_EQ(remove_small_regions(image, 1e-5).regions_removed, 0U);
}

/// A comb whose teeth meet only in the last slice, many slices from where they begin, is one region; teeth
/// that do not reach it are regions of their own.
TEST(VoxelRegions, AreJoinedOverAnyNumberOfSlices) {
  LabelImage image = testing::make_image({20, 3, 100}, {1, 1, 1}, 1, [](const Vec3& p) {
    const auto x = std::lround(p.x);
    const bool joined = x < 10 && std::lround(p.z) == 99;
    return joined || (x % 2 == 0 && std::lround(p.z) < 98) || (x % 2 == 0 && x < 10) ? 1 : 0;
  });
  LabelImage split = image;
  EXPECT_EQ(split_regions(split).regions, 1U + 5U);
  EXPECT_EQ(split.voxels_per_material()[1], 5U * 3U * 99U + 10U * 3U);
  const RegionReport report = remove_small_regions(image, 0.2);
  EXPECT_EQ(report.regions_removed, 5U);
  EXPECT_EQ(report.voxels_removed, 5U * 3U * 98U);
}

TEST(VoxelRegions, SplittingWidensAnImageOfManyRegions) {
  LabelImage image = testing::make_image({61, 11, 1}, {1, 1, 1}, 1, [](const Vec3& p) {
    return std::lround(p.x) % 2 == 0 && std::lround(p.y) % 2 == 0 ? 1 : 0;
  });
  EXPECT_FALSE(image.voxels.is_wide());
  EXPECT_EQ(split_regions(image).regions, 31U * 6U);
  EXPECT_FALSE(image.voxels.is_wide());  // 186 materials
  image = testing::make_image({61, 21, 1}, {1, 1, 1}, 1, [](const Vec3& p) {
    return std::lround(p.x) % 2 == 0 && std::lround(p.y) % 2 == 0 ? 1 : 0;
  });
  EXPECT_EQ(split_regions(image).regions, 31U * 11U);
  EXPECT_TRUE(image.voxels.is_wide());
  std::vector<std::size_t> voxels = image.voxels_per_material();
  voxels.erase(voxels.begin());
  EXPECT_EQ(voxels, std::vector<std::size_t>(31 * 11, 1));
}

}  // namespace
}  // namespace cbc3d

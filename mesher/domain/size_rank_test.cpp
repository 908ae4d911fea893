// Ranks of materials by their size.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "mesher/domain/size_rank.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

TEST(SizeRank, MaterialsAreCountedAtAnyThreadCount) {
  const LabelImage image = testing::noise_image(17, 0.4, 6);
  std::vector<std::size_t> count(4, 0), first(4, image.voxels.size());
  LabelImage more = image;
  more.labels.push_back(9);  // that no voxel has
  for (std::size_t v = image.voxels.size(); v-- > 0;) {
    ++count[image.voxels[v]];
    first[image.voxels[v]] = v;
  }
  testing::at_thread_counts([&] {
    const MaterialVoxels found = count_materials(more);
    EXPECT_EQ(found.count, count);
    EXPECT_EQ(found.first, first);
  });
}

TEST(SizeRank, TheSmallerIsTheHigherAndBackgroundWhereItIsPut) {
  const MaterialVoxels voxels{{500, 20, 7, 20}, {0, 30, 5, 11}};
  EXPECT_EQ(rank_by_size(voxels, BackgroundRank::lowest), (std::vector<std::uint32_t>{0, 1, 3, 2}));
  const auto high = rank_by_size(voxels, BackgroundRank::highest);
  EXPECT_EQ(high, (std::vector<std::uint32_t>{4, 1, 3, 2}));
  // As one class materials 1 and 2 have 27 voxels, more than material 3.
  EXPECT_EQ(rank_by_size(voxels, {0, 1, 1, 2}, BackgroundRank::lowest),
            (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace cbc3d

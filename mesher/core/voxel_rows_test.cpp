// Rows that are passed over in words, against a look at every voxel.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "mesher/core/voxel_rows.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(VoxelRows, BoundaryVoxelsAreThoseOfTheDefinition) {
  for (const int materials : {2, 300}) {
    std::mt19937 random(5);
    LabelImage image = testing::make_image({37, 9, 7}, {1, 1, 1}, materials, [](const Vec3&) { return 0; });
    image.voxels.hold(image.material_count());
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {  // long runs with a few changes
      image.voxels[v] = static_cast<MaterialId>(random() % 12 != 0 && v > 0 ? MaterialId{image.voxels[v - 1]}
                                                                            : random() % 3 * (materials / 2));
    }
    const BoundaryRows rows(image);
    for (int k = 0; k < 7; ++k) {
      for (int j = 0; j < 9; ++j) {
        std::vector<int> found, expected;
        rows.find(j, k, found);
        for (int i = 0; i < 37; ++i) {
          if (image.at(i, j, k) != kBackground && is_boundary_voxel(image, i, j, k)) {
            expected.push_back(i);
          }
        }
        EXPECT_EQ(found, expected);
      }
    }
  }
}

TEST(VoxelRows, RunsEndWhereTheValueChanges) {
  std::vector<std::uint16_t> row(50, 513);
  EXPECT_EQ(end_of_run(row.data(), 3, 50), 50);
  for (int at = 4; at < 50; ++at) {
    row.assign(50, 513);
    row[static_cast<std::size_t>(at)] = 1;  // the low byte alone would not show it
    EXPECT_EQ(end_of_run(row.data(), 3, 50), at);
    EXPECT_EQ(end_of_run(row.data(), 3, at), at);
  }
}

}  // namespace
}  // namespace cbc3d

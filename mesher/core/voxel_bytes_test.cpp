#include "mesher/core/voxel_bytes.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace cbc3d {
namespace {

TEST(VoxelBytes, VoxelsLieBehindTheHeader) {
  VoxelBytes voxels(8, 24);
  voxels.data()[-8] = 5;
  voxels.data()[23] = 7;
  const VoxelBytes moved = std::move(voxels);
  EXPECT_EQ(moved.data()[-8], 5);
  EXPECT_EQ(moved.data()[23], 7);
}

}  // namespace
}  // namespace cbc3d

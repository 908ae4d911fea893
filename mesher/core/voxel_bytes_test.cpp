#include "mesher/core/voxel_bytes.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace cbc3d {
namespace {

TEST(VoxelBytes, VoxelsLieBehindTheHeader) {
  VoxelBytes voxels(8, 24);
  EXPECT_EQ(voxels.whole().size(), 32U);
  EXPECT_EQ(voxels.data(), voxels.whole().data() + 8);
  voxels.data()[23] = 7;
  const VoxelBytes moved = std::move(voxels);
  EXPECT_EQ(moved.whole()[31], 7);
}

}  // namespace
}  // namespace cbc3d

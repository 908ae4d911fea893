// Simple voxels: known answers, and the count of parts, tunnels and cavities by brute force.
#include "mesher/domain/simple_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {
namespace {

VoxelNeighbourhood with(std::initializer_list<std::size_t> own) {
  VoxelNeighbourhood around{};
  for (const std::size_t n : own) around[n] = true;
  return around;
}

TEST(SimplePoint, AnEndIsAndABridgeIsNot) {
  EXPECT_TRUE(is_simple(with({12})));          // the end of a line
  EXPECT_FALSE(is_simple(with({12, 14})));     // its middle
  EXPECT_FALSE(is_simple(with({})));           // an isolated voxel
  EXPECT_FALSE(is_simple(with({0})));          // it touches a corner alone: apart from it
  EXPECT_FALSE(is_simple(with({12, 14, 0})));  // a corner joins nothing
  EXPECT_TRUE(is_simple(with({12, 14, 9, 10, 11})));
  VoxelNeighbourhood full;
  full.fill(true);
  EXPECT_FALSE(is_simple(full));  // it would leave a cavity
  full[14] = false;
  EXPECT_TRUE(is_simple(full));
  full[12] = false;
  EXPECT_FALSE(is_simple(full));  // it would leave a tunnel
}

/// Vertices less edges plus faces less voxels of the open set of voxels: that of connections across faces.
int euler(const VoxelNeighbourhood& around) {
  const ImageFrame cube{.size = {3, 3, 3}};
  const auto has = [&](int x, int y, int z) {
    return cube.contains(x, y, z) && around[cube.offset(x, y, z)];
  };
  int chi = 0;
  for (std::size_t v = 0; v < around.size(); ++v) {
    const auto [x, y, z] = cube.index_of(v);
    for (int block = 0; block < 8; ++block) {  // voxel, faces, edges and corners towards +
      bool all = true;
      for (int part = 0; part < 8; ++part) {
        const bool within = (part & ~block) == 0;
        all = all && (!within || has(x + (part & 1), y + (part >> 1 & 1), z + (part >> 2 & 1)));
      }
      const int dimensions = (block & 1) + (block >> 1 & 1) + (block >> 2);
      chi += all ? (dimensions % 2 == 0 ? 1 : -1) : 0;
    }
  }
  return chi;
}

/// The voxel alone decides about a change of Euler's number: 0 for every simple one.
TEST(SimplePoint, KeepsEulersNumberOfRandomSets) {
  std::mt19937 random(7);
  int simple = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    VoxelNeighbourhood around{};
    for (auto& own : around) own = random() % 2 == 0;
    if (!is_simple(around)) continue;
    ++simple;
    VoxelNeighbourhood in = around;
    VoxelNeighbourhood out = around;
    in[13] = true;
    out[13] = false;
    ASSERT_EQ(euler(in), euler(out)) << trial;
  }
  EXPECT_GT(simple, 500);
}

TEST(SimplePoint, NeighboursCountXFastest) {
  EXPECT_EQ(voxel_neighbour({4, 5, 6}, 13), (Index3{4, 5, 6}));
  EXPECT_EQ(voxel_neighbour({4, 5, 6}, 0), (Index3{3, 4, 5}));
  EXPECT_EQ(voxel_neighbour({4, 5, 6}, 14), (Index3{5, 5, 6}));
  EXPECT_EQ(voxel_neighbour({4, 5, 6}, 25), (Index3{4, 6, 7}));
}

}  // namespace
}  // namespace cbc3d

// Flags of voxels, set and found.
#include <gtest/gtest.h>

#include <vector>

#include "mesher/core/voxel_bits.hpp"

namespace cbc3d {
namespace {

TEST(VoxelBits, AreFoundInRanges) {
  VoxelBits bits(300);
  for (const std::size_t v : {0U, 63U, 64U, 130U, 299U}) {
    bits.set(v);
  }
  for (std::size_t begin = 0; begin < 300; begin += 7) {
    for (std::size_t end = begin; end <= 300; end += 13) {
      std::vector<std::size_t> found, expected;
      bits.for_each(begin, end, [&](std::size_t v) { found.push_back(v); });
      for (std::size_t v = begin; v < end; ++v) {
        if (bits.test(v)) {
          expected.push_back(v);
        }
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(bits.any(begin, end), !expected.empty());
    }
  }
  bits.clear();
  EXPECT_FALSE(bits.any(0, 300));
}

}  // namespace
}  // namespace cbc3d

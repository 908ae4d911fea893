// Sets of the materials at a point, against std::set.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "mesher/topology/material_set.hpp"

namespace cbc3d {
namespace {

TEST(MaterialSet, IsOrderedAndKeepsTheLowest) {
  MaterialSet set;
  for (const MaterialId m : {7, 3, 7, 9, 1}) set.add(m);
  ASSERT_EQ(set.size, 4U);
  EXPECT_EQ(set[0], 1);
  EXPECT_EQ(set[3], 9);
  EXPECT_FALSE(set.overflow);
  MaterialSet pair;
  pair.add(9);
  pair.add(3);
  EXPECT_TRUE(pair.is_within(set));
  EXPECT_FALSE(set.is_within(pair));
  MaterialSet down;
  MaterialSet up;
  for (MaterialId m = 0; m < 12; ++m) {
    up.add(m);
    down.add(static_cast<MaterialId>(11 - m));
  }
  EXPECT_EQ(up.size, MaterialSet::kCapacity);
  EXPECT_TRUE(up.overflow && down.overflow);
  EXPECT_EQ(up, down);
}

TEST(MaterialSet, IsThatOfAStandardSetInAnyOrder) {
  std::mt19937 random(4);
  for (int n = 0; n < 500; ++n) {
    std::set<MaterialId> expected;
    MaterialSet set;
    const auto count = random() % 14;
    for (unsigned i = 0; i < count; ++i) {
      const auto m = static_cast<MaterialId>(random() % 12);
      expected.insert(m);
      set.add(m);
    }
    EXPECT_EQ(set.overflow, expected.size() > MaterialSet::kCapacity);
    ASSERT_EQ(set.size, std::min(expected.size(), MaterialSet::kCapacity));
    std::size_t at = 0;
    for (const MaterialId m : expected) {
      EXPECT_EQ(set.has(m), at < set.size);
      if (at < set.size) {
        EXPECT_EQ(set[at], m);
      }
      ++at;
    }
  }
}

}  // namespace
}  // namespace cbc3d

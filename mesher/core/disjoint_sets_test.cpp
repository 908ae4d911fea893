#include "mesher/core/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(DisjointSets, TheLowestNumberIsTheRoot) {
  DisjointSets sets(6);
  EXPECT_EQ(sets.size(), 6U);
  EXPECT_EQ(sets.root(5), 5U);
  sets.join(5, 3);
  sets.join(4, 5);
  sets.join(1, 0);
  EXPECT_EQ(sets.root(4), 3U);
  EXPECT_EQ(sets.root(5), 3U);
  EXPECT_EQ(sets.root(1), 0U);
  EXPECT_EQ(sets.root(2), 2U);
  sets.join(4, 1);
  EXPECT_EQ(sets.root(5), 0U);
}

TEST(DisjointSets, MembersAreAscendingByTheirRoots) {
  DisjointSets sets(6);
  sets.join(5, 1);
  sets.join(2, 4);
  EXPECT_EQ(sets.members(), (std::vector<std::vector<std::uint32_t>>{{0}, {1, 5}, {2, 4}, {3}}));
  EXPECT_TRUE(DisjointSets(0).members().empty());
}

}  // namespace
}  // namespace cbc3d

// Stars in pieces: eight tets around a vertex, one for each octant.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "mesher/topology/vertex_star.hpp"

namespace cbc3d {
namespace {

/// Octant o is on the negative side of axis d where bit d of o is set.
TetNodes octants(unsigned count) {
  TetNodes tets;
  for (unsigned o = 0; o < count; ++o) {
    const VertexId x = (o & 1U) != 0 ? 2 : 1;
    const VertexId y = (o & 2U) != 0 ? 4 : 3;
    const VertexId z = (o & 4U) != 0 ? 6 : 5;
    tets.push_back(std::popcount(o) % 2 == 1 ? std::array<VertexId, 4>{0, y, x, z}
                                             : std::array<VertexId, 4>{0, x, y, z});
  }
  return tets;
}

/// Pieces of the octants that are of the class (or not), by flooding through faces.
int pieces_by_flooding(const std::vector<ClassId>& classes, ClassId of, bool inside) {
  std::set<unsigned> open;
  for (unsigned o = 0; o < 8; ++o) {
    if ((classes[o] == of) == inside) open.insert(o);
  }
  int pieces = 0;
  for (; !open.empty(); ++pieces) {
    std::vector<unsigned> stack = {*open.begin()};
    open.erase(open.begin());
    while (!stack.empty()) {
      const unsigned o = stack.back();
      stack.pop_back();
      for (const unsigned bit : {1U, 2U, 4U}) {
        if (open.erase(o ^ bit) > 0) stack.push_back(o ^ bit);
      }
    }
  }
  return pieces;
}

TEST(VertexStar, EveryPatternOfTwoClassesFallsIntoItsPieces) {
  const TetNodes tets = octants(8);
  const VertexCells around = tets_of_vertices(tets, 7);
  const TetNeighbours neighbours = tet_neighbours(tets, 7);
  VertexStar star(around, tets, neighbours);
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    std::vector<ClassId> classes(8);
    for (unsigned o = 0; o < 8; ++o) classes[o] = (pattern >> o & 1U) != 0 ? 5 : 2;
    star.load(0, classes, 9);
    ASSERT_EQ(star.size(), 8U);
    EXPECT_EQ(star.distinct().size(), pattern == 0 || pattern == 255 ? 1U : 2U);
    EXPECT_TRUE(std::is_sorted(star.distinct().begin(), star.distinct().end()));
    const int in = pieces_by_flooding(classes, 5, true);
    const int out = pieces_by_flooding(classes, 5, false);
    EXPECT_EQ(star.split(5, false), out);
    EXPECT_EQ(star.split(5, true), in) << pattern;
    for (std::size_t i = 0; i < star.size(); ++i) {
      EXPECT_EQ(star.class_of(i), classes[star.tet(i)]);
      EXPECT_EQ(star.piece(i) >= 0, star.class_of(i) == 5);
      EXPECT_LT(star.piece(i), in);
    }
    EXPECT_EQ(star.is_manifold(5), in <= 1 && out <= 1);
  }
}

TEST(VertexStar, TheOutsideIsAMemberWhereTheStarIsOpen) {
  const TetNodes tets = octants(4);  // a half space
  const VertexCells around = tets_of_vertices(tets, 7);
  const TetNeighbours neighbours = tet_neighbours(tets, 7);
  VertexStar star(around, tets, neighbours);
  star.load(0, {1, 1, 1, 1}, 0);
  EXPECT_EQ(star.size(), 5U);
  EXPECT_EQ(star.distinct(), (std::vector<ClassId>{0, 1}));
  EXPECT_TRUE(star.is_manifold(1));
  EXPECT_TRUE(star.is_manifold(0));
  star.load(0, {1, 2, 2, 1}, 0);  // two of a class meet by an edge
  EXPECT_FALSE(star.is_manifold(1));
  EXPECT_EQ(star.split(2, true), 2);
}

}  // namespace
}  // namespace cbc3d

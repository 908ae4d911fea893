// Neighbours along interfaces, counted by the facets at the edges to them.
#include <gtest/gtest.h>

#include "mesher/improve/local/surface_neighbours.hpp"

namespace cbc3d {
namespace {

TEST(SurfaceNeighbours, AClosedFanHasTwoFacetsAtEveryEdge) {
  std::vector<SurfaceNeighbour> neighbours;
  surface_neighbours({{1, 2, 1, 0}, {2, 3, 1, 0}, {3, 1, 1, 0}}, neighbours);
  ASSERT_EQ(neighbours.size(), 3U);
  EXPECT_EQ(neighbours[0].vertex, 1U);  // in order of first sight
  for (const VertexId v : {1U, 2U, 3U}) {
    EXPECT_EQ(facets_to(neighbours, v), 2U);
  }
  EXPECT_EQ(facets_to(neighbours, 4), 0U);
}

TEST(SurfaceNeighbours, WhereThreeInterfacesMeetTheEdgeHasThree) {
  std::vector<SurfaceNeighbour> neighbours = {{9, 9}};  // what was there is forgotten
  surface_neighbours({{1, 2, 1, 0}, {1, 3, 2, 0}, {1, 4, 2, 1}}, neighbours);
  EXPECT_EQ(neighbours.size(), 4U);
  EXPECT_EQ(facets_to(neighbours, 1), 3U);
  EXPECT_EQ(facets_to(neighbours, 2), 1U);
}

}  // namespace
}  // namespace cbc3d

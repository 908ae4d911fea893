#include "baselines/cleaver/cut_lattice.hpp"

#include <gtest/gtest.h>

#include "baselines/cleaver/testing_lattice.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(CutLattice, EveryEdgeBetweenMaterialsHasOneCutOnThePlane) {
  const testing::PlaneIndicators plane({0.6, 0, 0.8}, 4.3);
  Lattice lattice = testing::uniform_lattice(6);
  std::vector<MaterialId> materials = testing::materials_at(lattice.points, plane);
  const CutLattice cut = cut_edges(std::move(lattice), std::move(materials), plane);
  EXPECT_FALSE(cut.mixed.empty());
  for (const Cut& c : cut.cuts) {
    EXPECT_LT(c.first, c.second);
    EXPECT_NEAR(plane.height(cut.place_of(c)), 0, 1e-6);
  }
  for (const MixedTet& mixed : cut.mixed) {
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& nodes = cut.lattice.tets[mixed.tet];
      const VertexId a = nodes[kTetEdge[e][0]], b = nodes[kTetEdge[e][1]];
      ASSERT_EQ(mixed.cuts[e] == kNone, cut.materials[a] == cut.materials[b]);
      if (mixed.cuts[e] == kNone) continue;
      EXPECT_EQ(cut.cuts[mixed.cuts[e]].first, std::min(a, b));
      EXPECT_EQ(cut.cuts[mixed.cuts[e]].second, std::max(a, b));
    }
  }
}

TEST(CutLattice, FacesAndEdgesOfATetAgree) {
  for (std::size_t e = 0; e < 6; ++e) EXPECT_EQ(kEdgeBetween[kTetEdge[e][0]][kTetEdge[e][1]], e);
  for (std::size_t f = 0; f < 4; ++f) {
    for (const std::uint8_t corner : kTetFace[f]) EXPECT_NE(corner, f);
  }
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

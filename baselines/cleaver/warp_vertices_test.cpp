#include "baselines/cleaver/warp_vertices.hpp"

#include <gtest/gtest.h>

#include "baselines/cleaver/testing_lattice.hpp"
#include "baselines/cleaver/tet_angles.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(WarpVertices, LeavesNoCutThatViolatesAVertexAndAllTetsGood) {
  const testing::RandomIndicators indicators(4, 4);
  Lattice lattice = testing::uniform_lattice(10);
  std::vector<MaterialId> materials = testing::inner_materials(lattice, indicators, 10, 1.6);
  CutLattice cut = cut_edges(std::move(lattice), std::move(materials), indicators);
  set_alphas(cut);
  warp_vertices(cut, indicators);
  for (const Cut& c : cut.cuts) {
    if (c.place != CutPlace::kWithin) continue;
    EXPECT_GE(c.fraction, c.alpha_first);
    EXPECT_LE(c.fraction, 1 - c.alpha_second + 1e-6F);
  }
  for (const auto& n : cut.lattice.tets) {
    const auto& p = cut.lattice.points;
    ASSERT_TRUE(has_angles_within({p[n[0]], p[n[1]], p[n[2]], p[n[3]]}, kLeastAngleDeg, kMostAngleDeg));
  }
}

TEST(WarpVertices, VerticesNearAPlaneMoveOntoIt) {
  const testing::PlaneIndicators plane({0, 0, 1}, 4.1);
  Lattice lattice = testing::uniform_lattice(8);
  const std::vector<Vec3> before = lattice.points;
  std::vector<MaterialId> materials = testing::materials_at(lattice.points, plane);
  CutLattice cut = cut_edges(std::move(lattice), std::move(materials), plane);
  set_alphas(cut);
  warp_vertices(cut, plane);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (cut.lattice.points[v] == before[v]) continue;
    ++moved;
    EXPECT_NEAR(plane.height(cut.lattice.points[v]), 0, 1e-6);
    EXPECT_NEAR(before[v].z, 4, 1e-9);
  }
  EXPECT_GT(moved, 0U);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

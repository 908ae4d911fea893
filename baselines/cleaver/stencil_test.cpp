#include "baselines/cleaver/stencil.hpp"

#include <gtest/gtest.h>

#include "baselines/cleaver/testing_lattice.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// Cleaves with no label near the lattice's surface, which then is where it was.
void expect_all_of_the_lattice(Lattice lattice, double edge, double rim, std::uint64_t seed, int materials) {
  const testing::RandomIndicators indicators(seed, materials);
  const double volume = testing::total_volume(lattice.tets, lattice.points);
  std::vector<MaterialId> of_vertices = testing::inner_materials(lattice, indicators, edge, rim);
  const CutLattice cut = testing::cut_and_warped(std::move(lattice), std::move(of_vertices), indicators);
  const CleavedMesh mesh = cleave_tets(cut, indicators, true);
  EXPECT_EQ(cbc3d::testing::inverted_tets(mesh.tets, mesh.points), 0U);
  EXPECT_EQ(cbc3d::testing::crowded_faces(mesh.tets), 0U);
  EXPECT_NEAR(testing::total_volume(mesh.tets, mesh.points) / volume, 1, 1e-12);
}

TEST(Stencil, FillsTheUniformLatticeExactly) {
  for (int materials = 2; materials < 9; ++materials) {
    expect_all_of_the_lattice(testing::uniform_lattice(9), 9, 1.6, static_cast<std::uint64_t>(materials),
                              materials);
  }
}

TEST(Stencil, FillsGradedLatticesExactly) {
  std::mt19937 random(2);
  for (int materials = 2; materials < 6; ++materials) {
    expect_all_of_the_lattice(testing::graded_lattice(32, random), 32, 12.1,
                              static_cast<std::uint64_t>(materials), materials);
  }
}

TEST(Stencil, LeavesOutBackgroundAndIsTheSameAtAnyThreadCount) {
  const testing::RandomIndicators indicators(1, 4);
  CleavedMesh first;
  cbc3d::testing::at_thread_counts([&] {
    Lattice lattice = testing::uniform_lattice(10);
    std::vector<MaterialId> materials = testing::inner_materials(lattice, indicators, 10, 1.6);
    CleavedMesh mesh = cleave_tets(
        testing::cut_and_warped(std::move(lattice), std::move(materials), indicators), indicators);
    EXPECT_EQ(std::count(mesh.materials.begin(), mesh.materials.end(), kBackground), 0);
    if (first.tets.empty()) first = mesh;
    EXPECT_EQ(mesh.tets, first.tets);
    EXPECT_EQ(mesh.points, first.points);
    EXPECT_EQ(mesh.materials, first.materials);
  });
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

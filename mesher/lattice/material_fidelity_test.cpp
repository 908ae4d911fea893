// The two fidelities, and the words for what is not met.
#include "mesher/lattice/material_fidelity.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(MaterialFidelity, BothSharesMustBeMet) {
  MaterialFidelity f{
      .material = 1, .label = 7, .wanted = 0.9, .mesh_voxels = 100, .image_voxels = 80, .common_voxels = 76};
  EXPECT_DOUBLE_EQ(f.f1(), 0.76);
  EXPECT_DOUBLE_EQ(f.f2(), 0.95);
  EXPECT_FALSE(f.met());
  f.wanted = 0.76;
  EXPECT_TRUE(f.met());
  EXPECT_DOUBLE_EQ((MaterialFidelity{.image_voxels = 5}.f1()), 0);  // nothing in the mesh
  EXPECT_DOUBLE_EQ((MaterialFidelity{.mesh_voxels = 5}.f2()), 1);   // nothing asked for
}

TEST(MaterialFidelity, ALabelHasOneLineWithItsWorstRegion) {
  const std::vector<MaterialFidelity> fidelity = {
      {.material = 1, .label = 3, .wanted = 0.9, .mesh_voxels = 10, .image_voxels = 10, .common_voxels = 10},
      {.material = 2, .label = 3, .wanted = 0.9, .mesh_voxels = 10, .image_voxels = 10, .common_voxels = 8},
      {.material = 3, .label = 3, .wanted = 0.9, .mesh_voxels = 10, .image_voxels = 10, .common_voxels = 5},
      {.material = 4, .label = 9, .wanted = 0.9, .mesh_voxels = 10, .image_voxels = 10, .common_voxels = 10}};
  const auto warnings = warnings_of_unmet_fidelity(fidelity, 0.25);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(
      warnings[0],
      "label 3: fidelity 0.900 not met in 2 of its 3 regions (worst: F1 = 0.5000, F2 = 0.5000): the lattice "
      "may not be finer than 0.25 mm");
}

TEST(MaterialFidelity, IsWantedOfEveryMaterialByItsLabel) {
  const auto wanted = wanted_fidelity({0, 3, 3, 8}, {100, 20, 5, 7}, 0.9, {{3, 0.5}});
  ASSERT_EQ(wanted.size(), 4U);
  EXPECT_EQ(wanted[2].material, 2);
  EXPECT_EQ(wanted[2].label, 3);
  EXPECT_EQ(wanted[2].wanted, 0.5);
  EXPECT_EQ(wanted[2].image_voxels, 5U);
  EXPECT_EQ(wanted[3].wanted, 0.9);
  EXPECT_EQ(warning_of_uncovered(3, 1.5, 0.25),
            "3 boundary voxels lie farther than 1.5 mm from the interface at the finest spacing 0.25 mm");
}

}  // namespace
}  // namespace cbc3d

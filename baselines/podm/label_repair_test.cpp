#include "baselines/podm/label_repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d::baselines::podm {
namespace {

// A box of tets of material 1 with its neighbours.
LabelledComplex box() {
  LabelledComplex complex;
  const cbc3d::testing::KuhnBox cubes(4);
  complex.points = cubes.points;
  complex.tets = cubes.tets;
  complex.materials.assign(cubes.tets.size(), 1);
  complex.neighbours.assign(cubes.tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  std::map<cbc3d::testing::FaceKey, std::pair<std::uint32_t, std::size_t>> open;
  for (std::uint32_t t = 0; t < cubes.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const auto [entry, is_new] = open.try_emplace(cbc3d::testing::face_key(cubes.tets[t], n), t, n);
      if (is_new) continue;
      complex.neighbours[t][n] = entry->second.first;
      complex.neighbours[entry->second.first][entry->second.second] = t;
    }
  }
  return complex;
}

std::function<MaterialId(const Vec3&)> everywhere(MaterialId material) {
  return [material](const Vec3&) { return material; };
}

// A tet with four neighbours, none of which is a neighbour of the box's first tets.
std::uint32_t inner_tet(const LabelledComplex& complex) {
  for (std::uint32_t t = 150; t < complex.tets.size(); ++t) {
    const auto& n = complex.neighbours[t];
    if (std::find(n.begin(), n.end(), kNoTet) == n.end()) return t;
  }
  return kNoTet;
}

TEST(LabelRepair, ASingleTetAmongOthersGetsTheirMaterial) {
  LabelledComplex complex = box();
  const std::uint32_t orphan = inner_tet(complex);
  complex.materials[0] = complex.materials[complex.neighbours[0][0] == kNoTet ? complex.neighbours[0][1]
                                                                              : complex.neighbours[0][0]] = 2;
  complex.materials[orphan] = 2;
  EXPECT_EQ(repair_orphans(complex, 8, everywhere(1)), 1U);
  EXPECT_EQ(complex.materials[orphan], 1);
  EXPECT_EQ(complex.materials[0], 2);
}

TEST(LabelRepair, AHoleOfBackgroundIsFilledAndTheOutsideStays) {
  LabelledComplex complex = box();
  const std::uint32_t orphan = inner_tet(complex);
  for (std::uint32_t t = 0; t < 40; ++t) complex.materials[t] = kBackground;
  complex.materials[orphan] = kBackground;
  EXPECT_EQ(repair_orphans(complex, 8, everywhere(1)), 1U);
  EXPECT_EQ(complex.materials[orphan], 1);
  EXPECT_EQ(complex.materials[5], kBackground);
}

TEST(LabelRepair, TheOnlyTetOfAMaterialStays) {
  LabelledComplex complex = box();
  const std::uint32_t only = inner_tet(complex);
  complex.materials[only] = 7;
  EXPECT_EQ(repair_orphans(complex, 8, everywhere(1)), 0U);
  EXPECT_EQ(complex.materials[only], 7);
}

TEST(LabelRepair, ASmallPieceThatTheImageHasStays) {
  LabelledComplex complex = box();
  const std::uint32_t island = inner_tet(complex);
  complex.materials[island] = kBackground;
  for (std::uint32_t t = 0; t < 40; ++t) complex.materials[t] = kBackground;
  EXPECT_EQ(repair_orphans(complex, 8, everywhere(kBackground)), 0U);
  EXPECT_EQ(complex.materials[island], kBackground);
}

TEST(LabelRepair, MeshHasNoBackgroundAndOnlyVerticesInUse) {
  LabelledComplex complex = box();
  for (std::uint32_t t = 1; t < complex.tets.size(); ++t) complex.materials[t] = kBackground;
  const Mesh mesh = mesh_of(complex, {0, -42});
  EXPECT_EQ(mesh.tets.size(), 1U);
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(labels_of(mesh), std::vector<Label>{-42});
  EXPECT_EQ(cbc3d::testing::inverted_tets(mesh.tets.nodes, mesh.points), 0U);
}

}  // namespace
}  // namespace cbc3d::baselines::podm

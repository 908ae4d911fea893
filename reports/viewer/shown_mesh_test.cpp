#include "reports/viewer/shown_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "reports/viewer/testing_box.hpp"

namespace cbc3d::reports {
namespace {

using testing::box;

std::size_t facets(const ShownMesh& mesh) {
  return std::accumulate(
      mesh.boundary.begin(), mesh.boundary.end(), std::size_t{0},
      [](std::size_t sum, std::uint8_t bits) { return sum + static_cast<std::size_t>(std::popcount(bits)); });
}

TEST(ShownMesh, ASmallMeshIsShownAsItIs) {
  const ShownMesh shown = shown_mesh(box(4), 1000);
  EXPECT_EQ(shown.tets.size(), 6U * 64);
  EXPECT_EQ(shown.tets_of_mesh, 6U * 64);
  EXPECT_EQ(shown.merged_within_mm, 0);
  EXPECT_EQ(shown.labels, (std::vector<Label>{1, 2}));
  // Two triangles for each of the 6 x 16 squares outside, and for each side of the 16 between the labels.
  EXPECT_EQ(facets(shown), 2U * 6 * 16 + 2U * 2 * 16);
  for (std::size_t t = 0; t < shown.tets.size(); ++t) {
    EXPECT_NEAR(shown.min_dihedral_deg[t], 45, 1e-4);
  }
}

TEST(ShownMesh, ALargeMeshIsSimplifiedToTheLimitAndKeepsItsShape) {
  constexpr std::size_t kMost = 1000;
  const ShownMesh shown = shown_mesh(box(12), kMost);
  EXPECT_EQ(shown.tets_of_mesh, 6U * 12 * 12 * 12);
  EXPECT_LE(shown.tets.size(), kMost);
  EXPECT_GT(shown.tets.size(), kMost / 20);
  EXPECT_GT(shown.merged_within_mm, 1);
  EXPECT_EQ(shown.label_index.size(), shown.tets.size());
  EXPECT_EQ(shown.min_dihedral_deg.size(), shown.tets.size());
  EXPECT_EQ(shown.mean_ratio.size(), shown.tets.size());
  EXPECT_EQ(shown.boundary.size(), shown.tets.size());
  EXPECT_GT(facets(shown), 0U);
  for (const auto& tet : shown.tets) {
    for (const VertexId corner : tet) {
      ASSERT_LT(corner, shown.points.size());
    }
  }
  for (const Label label : {0, 1}) {
    EXPECT_TRUE(std::any_of(shown.label_index.begin(), shown.label_index.end(),
                            [label](std::uint16_t index) { return index == label; }));
  }
}

TEST(ShownMesh, TheWorstTetsKeepTheirShapeWhateverIsMerged) {
  Mesh mesh = box(8);
  const auto sliver = static_cast<VertexId>(mesh.points.size());
  for (const Vec3& p : {Vec3{20, 0, 0}, Vec3{21, 0, 0}, Vec3{20, 1, 0}, Vec3{20.3, 0.3, 0.01}}) {
    mesh.points.push_back(p);
  }
  mesh.tets.add({sliver, sliver + 1, sliver + 2, sliver + 3}, 7);
  const ShownMesh shown = shown_mesh(mesh, 300, 5);
  ASSERT_EQ(shown.worst.size(), 5U);
  EXPECT_EQ(shown.labels[shown.worst[0].label], 7);
  EXPECT_LT(shown.worst[0].min_dihedral_deg, 5);
  EXPECT_EQ(shown.worst[0].points[3], (Vec3{20.3, 0.3, 0.01}));
  EXPECT_NEAR(shown.worst[1].min_dihedral_deg, 45, 1e-4);
}

TEST(ShownMesh, AnInvertedTetIsTheWorstOfAll) {
  Mesh mesh = box(2);
  std::swap(mesh.tets.nodes[30][0], mesh.tets.nodes[30][1]);
  const ShownMesh shown = shown_mesh(mesh, 1000, 1);
  EXPECT_LT(shown.worst.at(0).mean_ratio, 0);
}

TEST(ShownMesh, CellsOfAllKindsAreSplit) {
  const ShownMesh shown = shown_mesh(cbc3d::testing::one_of_each(), 1000);
  EXPECT_EQ(shown.tets_of_mesh, 1U + 2 + 3 + 6);
  EXPECT_EQ(shown.labels, (std::vector<Label>{3, 4, 5, 6}));
}

TEST(ShownMesh, AVertexThatIsNotThereIsRefused) {
  Mesh mesh = box(1);
  mesh.tets.nodes[2][3] = 99;
  EXPECT_THROW(shown_mesh(mesh, 1000), InputError);
}

TEST(ShownMesh, SmallMeshesLeaveTheirShareToTheLarge) {
  EXPECT_EQ(tets_for_each({10, 20, 1000, 1000}, 230), 100U);
  EXPECT_EQ(tets_for_each({1000, 10, 1000}, 1010), 500U);
  EXPECT_EQ(tets_for_each({10, 20}, 1000), 20U);
  EXPECT_EQ(tets_for_each({}, 5), 5U);
}

}  // namespace
}  // namespace cbc3d::reports

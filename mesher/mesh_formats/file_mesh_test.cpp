// What writers see of a mesh: facets outwards, interfaces with names, nodes apart where that is asked.
#include "mesher/mesh_formats/file_mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesher/mesh_formats/testing_meshes.hpp"

namespace cbc3d {
namespace {

Vec3 area_of(const FileMesh& mesh, const CellFacet& facet) {
  std::array<VertexId, 6> n;
  mesh.nodes_of(facet, n);
  const auto p = mesh.points();
  return 0.5 * (p[n[1]] - p[n[0]]).cross(p[n[2]] - p[n[0]]);
}

TEST(FileMesh, NormalsPointOutOfTheLabel) {
  const Mesh mesh = testing::two_label_box(2);  // label 7 at x < 0.5
  const FileMesh view(mesh, {});
  ASSERT_EQ(view.interfaces().size(), 3U);
  const Interface& between = view.interfaces()[0];
  EXPECT_EQ(between.label, 3);
  EXPECT_EQ(between.other, 7);
  for (std::size_t f = 0; f < between.facets.size(); ++f) {
    EXPECT_NEAR(area_of(view, between.facets[f]).x, -0.125, 1e-12) << "from label 3, which is above";
    EXPECT_NEAR(area_of(view, between.opposite[f]).x, 0.125, 1e-12);
  }
  EXPECT_EQ(view.labels(), (std::vector<Label>{3, 7}));
  EXPECT_FALSE(view.is_quadratic());
}

TEST(FileMesh, NamesItsInterfaces) {
  LabelNames names;
  names.set({.label = 3, .name = "left lung", .colour = {}});
  EXPECT_EQ(interface_name({.label = 3, .other = 7, .facets = {}, .opposite = {}}, names),
            "left_lung__label_7");
  EXPECT_EQ(interface_name({.label = 3, .other = 7, .facets = {}, .opposite = {}}, names, true),
            "label_7__left_lung");
  EXPECT_EQ(interface_name({.label = 3, .other = {}, .facets = {}, .opposite = {}}, names),
            "left_lung__exterior");
}

TEST(FileMesh, QuadraticFacetsHaveTheNodesOfTheirEdges) {
  const QuadraticMesh mesh = straight_quadratic_mesh(testing::two_label_box(2));
  const FileMesh view(mesh, {});
  EXPECT_TRUE(view.is_quadratic());
  for (const Interface& interface : view.interfaces()) {
    for (const CellFacet& facet : interface.facets) {
      std::array<VertexId, 6> n;
      ASSERT_EQ(view.nodes_of(facet, n), 6U);
      for (std::size_t e = 0; e < 3; ++e) {
        EXPECT_EQ(mesh.points[n[3 + e]], 0.5 * (mesh.points[n[e]] + mesh.points[n[(e + 1) % 3]]));
      }
    }
  }
}

TEST(FileMesh, SplitNodesBelongToOneLabel) {
  const Mesh mesh = testing::two_label_box(2);
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  const FileMesh linear(mesh, {.split = true}), curved(quadratic, {.split = true});
  EXPECT_EQ(linear.points().size(), 27U + 9) << "3 x 3 corners between the labels";
  EXPECT_EQ(curved.points().size(), 125U + 25);
  for (const FileMesh* view : {&linear, &curved}) {
    std::map<VertexId, std::set<Label>> labels;
    for (const FileCells& block : view->blocks()) {
      for (std::size_t n = 0; n < block.nodes.size(); ++n) {
        labels[block.nodes[n]].insert(block.labels[n / block.nodes_per_cell]);
      }
    }
    for (const auto& [node, of] : labels) EXPECT_EQ(of.size(), 1U);
    ASSERT_EQ(view->interfaces().size(), 3U) << "those of the shared nodes";
    std::array<VertexId, 6> a, b;
    view->nodes_of(view->interfaces()[0].facets[0], a);
    view->nodes_of(view->interfaces()[0].opposite[0], b);
    std::set<VertexId> shared(a.begin(), a.begin() + 3);
    for (std::size_t n = 0; n < 3; ++n) EXPECT_FALSE(shared.contains(b[n]));
  }
}

TEST(FileMesh, CellsOfALabelTogether) {
  const Mesh mesh = testing::two_label_box(2);
  const FileMesh view(mesh, {});
  const auto order = cells_by_label(view.blocks()[0]);
  ASSERT_EQ(order.size(), 48U);
  for (std::size_t c = 1; c < 48; ++c) {
    EXPECT_LE(mesh.tets.labels[order[c - 1]], mesh.tets.labels[order[c]]);
  }
}

}  // namespace
}  // namespace cbc3d

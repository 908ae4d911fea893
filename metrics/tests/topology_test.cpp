#include <gtest/gtest.h>

#include "metrics/tests/helpers.hpp"

namespace cbc3d::metrics {
namespace {

nlohmann::json topology_of(const Mesh& mesh) {
  return test::judge(mesh, test::two_boxes())["topology"];
}

// Positive tet whatever the order of its vertices.
void add_tet(Mesh& mesh, std::array<VertexId, 4> tet, Label label = 1) {
  const auto& p = mesh.points;
  if (six_volumes(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[2], tet[3]);
  mesh.tets.add(tet, label);
}

TEST(Topology, TwoTetsAtAFace) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["conforming"], true);
  EXPECT_EQ(found["non_manifold_edges"], 0);
  EXPECT_EQ(found["non_manifold_vertices"], 0);
  EXPECT_EQ(found["components"], 1);
}

TEST(Topology, TwoTetsAtAnEdge) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 4, 5});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["conforming"], true);
  EXPECT_EQ(found["non_manifold_edges"], 1);
  EXPECT_EQ(found["non_manifold_vertices"], 0);
  EXPECT_EQ(found["components"], 2);
}

TEST(Topology, TwoTetsAtAVertex) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 4, 5, 6});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["non_manifold_edges"], 0);
  EXPECT_EQ(found["non_manifold_vertices"], 1);
}

TEST(Topology, ManifoldIsAskedPerLabel) {
  // Four labels around an edge: the union of the interfaces branches there, no single surface does.
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  add_tet(mesh, {0, 1, 2, 3}, 1);
  add_tet(mesh, {0, 1, 3, 4}, 2);
  add_tet(mesh, {0, 1, 4, 5}, 3);
  add_tet(mesh, {0, 1, 5, 2}, 4);
  EXPECT_EQ(topology_of(mesh)["non_manifold_edges"], 0);
  mesh.tets.labels[2] = 1;
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["non_manifold_edges"], 1);
  EXPECT_EQ(found["per_label"][0]["non_manifold_edges"], 1);
  EXPECT_EQ(found["per_label"][0]["components"], 2);
  EXPECT_EQ(found["per_label"][1]["non_manifold_edges"], 0);
}

TEST(Topology, InvertedCellDoesNotConform) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  std::swap(mesh.tets.nodes[1][0], mesh.tets.nodes[1][1]);
  EXPECT_EQ(topology_of(mesh)["conforming"], false);
}

TEST(Topology, ThreeCellsAtAFacetDoNotConform) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {.1, .1, 2}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  add_tet(mesh, {0, 1, 2, 5});
  EXPECT_EQ(topology_of(mesh)["conforming"], false);
}

Mesh hex_with_lid(bool pyramid) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},    {0, 0, 1},
                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {.5, .5, 1.5}};
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  if (pyramid) {
    mesh.pyramids.add({4, 5, 6, 7, 8}, 1);
  } else {
    add_tet(mesh, {4, 5, 6, 8});
    add_tet(mesh, {4, 6, 7, 8});
  }
  return mesh;
}

TEST(Topology, QuadMeetsQuadsOnly) {
  const auto good = topology_of(hex_with_lid(true));
  EXPECT_EQ(good["conforming"], true);
  EXPECT_EQ(good["components"], 1);
  EXPECT_EQ(good["non_manifold_edges"], 0);
  EXPECT_EQ(topology_of(hex_with_lid(false))["conforming"], false);
}

TEST(Topology, CrossedQuadsDoNotMatch) {
  // The second hex runs the shared quad's vertices in an order that crosses.
  Mesh mesh = hex_with_lid(true);
  mesh.pyramids.nodes[0] = {4, 6, 5, 7, 8};
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["components"], 2);
}

TEST(Topology, HangingVerticesAreFound) {
  // One tet above, two below that halve its base at the middle of an edge.
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 0}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 5, 4});
  add_tet(mesh, {0, 5, 2, 4});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["hanging_vertices"], 1);
  EXPECT_EQ(found["conforming"], false);
}

TEST(Topology, CoincidentVerticesHang) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {4, 5, 6, 7});
  EXPECT_EQ(topology_of(mesh)["hanging_vertices"], 6);
}

}  // namespace
}  // namespace cbc3d::metrics

#include "metrics/gradation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

Gradation gradation_of(const Mesh& mesh) {
  const LabelImage image = test::two_boxes();
  const MeshView view(mesh, image);
  const std::vector<Facet> facets = sorted_facets(view);
  return gradation(view, facets, extract_surface(view, facets));
}

// `count` tets around an edge of length 2, the ring at a distance of 1 from it.
Mesh hub(int count) {
  Mesh mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}};
  for (int n = 0; n < count; ++n) {
    mesh.points.push_back({std::cos(2 * M_PI * n / count), std::sin(2 * M_PI * n / count), 0});
  }
  for (int n = 0; n < count; ++n) {
    const auto a = static_cast<VertexId>(2 + n), b = static_cast<VertexId>(2 + (n + 1) % count);
    mesh.tets.add({0, a, b, 1}, 1);
  }
  return mesh;
}

TEST(Gradation, PlantedHub) {
  for (const int count : {5, 24, 125}) {
    const Gradation found = gradation_of(hub(count));
    EXPECT_EQ(found.valence_max.value(), count + 1);
    EXPECT_EQ(found.valence_max_vertex, 0U);
    EXPECT_EQ(found.valence_median.value(), 4);  // two poles and two neighbours in the ring
    EXPECT_NEAR(found.size_ratio_max.value(), 1, 1e-6);
    // Side of the ring against the longest edge there: sqrt(2) at the ring.
    const double side = 2 * std::sin(M_PI / count);
    EXPECT_NEAR(found.vertex_edge_ratio_max.value(), std::max(std::sqrt(2.0), std::sqrt(2.0) / side),
                1e-5 / side);
    EXPECT_EQ(found.all.vertices, count + 2);
    EXPECT_EQ(found.all.inner, 0);
  }
}

TEST(Gradation, PercentilesOfAHub) {
  // 99 % of 127 vertices are 126 of them: the ring's 125 and one of the two poles; of 302 the ring alone.
  EXPECT_EQ(gradation_of(hub(125)).valence_p99.value(), 126);
  EXPECT_EQ(gradation_of(hub(300)).valence_p99.value(), 4);
  // The ring's vertices, nearly all, have the edges sqrt(2) and the side of the ring.
  const double side = 2 * std::sin(M_PI / 300);
  EXPECT_NEAR(gradation_of(hub(300)).vertex_edge_ratio_p99.value(), std::sqrt(2.0) / side, 1e-4);
}

TEST(Gradation, SizeRatioIsThatOfLengths) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -8}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  mesh.tets.add({0, 2, 1, 4}, 2);
  const Gradation found = gradation_of(mesh);
  EXPECT_NEAR(found.size_ratio_max.value(), 2, 1e-6);
  EXPECT_NEAR(found.size_ratio_p99.value(), 2, 1e-6);
}

TEST(Gradation, BccLattice) {
  constexpr int kSide = 6;
  const Gradation found = gradation_of(test::bcc_block(kSide, 2.5, 1));
  EXPECT_EQ(found.valence_max.value(), 14);  // 8 nearest, 6 next of its own kind
  EXPECT_NEAR(found.size_ratio_max.value(), 1, 1e-6);
  EXPECT_NEAR(found.vertex_edge_ratio_max.value(), 2 / std::sqrt(3.0), 1e-6);
}

TEST(Gradation, InnerVerticesOfTwoBoxes) {
  // Voxels 3 x 4 x 3 and 2 x 4 x 3, face to face.
  const Mesh mesh = test::kuhn_mesh(test::two_boxes());
  const Gradation found = gradation_of(mesh);
  EXPECT_EQ(found.all.vertices, 6 * 5 * 4);
  EXPECT_EQ(found.all.inner, 4 * 3 * 2);
  EXPECT_EQ(found.off_all_surfaces, (2 + 1) * 3 * 2);
  ASSERT_EQ(found.per_label.size(), 2U);
  EXPECT_EQ(found.per_label[0].vertices, 4 * 5 * 4);
  EXPECT_EQ(found.per_label[0].inner, 2 * 3 * 2);
  EXPECT_EQ(found.per_label[1].vertices, 3 * 5 * 4);
  EXPECT_EQ(found.per_label[1].inner, 1 * 3 * 2);
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  EXPECT_EQ(quality["inner_vertices"], 24);
  EXPECT_EQ(quality["inner_vertices_percent"], 20.0);
  EXPECT_EQ(quality["per_label"][1]["inner_vertices_percent"], 10.0);
}

TEST(Gradation, HexesHaveTheirOwnEdgesAlone) {
  Mesh mesh;
  for (const double z : {0, 1, 2}) {
    for (const double y : {0, 1, 2}) {
      for (const double x : {0, 1, 2}) mesh.points.push_back({x, y, z});
    }
  }
  for (const VertexId v : {0U, 1U, 3U, 4U, 9U, 10U, 12U, 13U}) {
    mesh.hexes.add({v, v + 1, v + 4, v + 3, v + 9, v + 10, v + 13, v + 12}, 1);
  }
  const Gradation found = gradation_of(mesh);
  EXPECT_EQ(found.valence_max.value(), 6);
  EXPECT_EQ(found.all.inner, 1);
}

TEST(Gradation, EmptyMeshAndFlatNeighbour) {
  const Gradation none = gradation_of({});
  EXPECT_FALSE(none.valence_max);
  EXPECT_FALSE(none.size_ratio_max);
  EXPECT_FALSE(none.all.percent());
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  mesh.tets.add({0, 2, 1, 4}, 1);
  EXPECT_TRUE(std::isinf(gradation_of(mesh).size_ratio_max.value()));
  EXPECT_TRUE(test::judge(mesh, test::two_boxes())["quality"]["neighbour_size_ratio"]["max"].is_null());
}

}  // namespace
}  // namespace cbc3d::metrics

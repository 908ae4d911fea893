// Orientation and labels of cells of every kind.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

double six_of(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  return six_volumes(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
}

/// By the corner at node 0 of each cell, in the orders that Mesh names.
std::array<double, 4> corners(const Mesh& mesh) {
  const auto& t = mesh.tets.nodes[0];
  const auto& p = mesh.pyramids.nodes[0];
  const auto& w = mesh.wedges.nodes[0];
  const auto& h = mesh.hexes.nodes[0];
  return {six_of(mesh, t[0], t[1], t[2], t[3]), six_of(mesh, p[0], p[1], p[3], p[4]),
          six_of(mesh, w[0], w[1], w[2], w[3]), six_of(mesh, h[0], h[1], h[3], h[4])};
}

TEST(Mesh, SixVolumesOfTheUnitTet) {
  const Vec3 o, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(six_volumes(o, x, y, z), 1);
  EXPECT_EQ(six_volumes(o, y, x, z), -1);
  EXPECT_EQ(six_volumes(o, x, y, x + y), 0);
}

TEST(Mesh, AMapToPhysicalSpaceKeepsCellsPositive) {
  for (const bool flipped : {false, true}) {
    Mesh mesh = testing::one_of_each();
    const std::array<double, 4> before = corners(mesh);
    const ImageFrame frame = testing::oblique(ImageFrame{}, flipped);
    ASSERT_EQ(frame.left_handed(), flipped);
    const Vec3 first = mesh.points[5];
    map_to_physical(mesh, frame);
    EXPECT_LT((frame.to_local(mesh.points[5]) - first).norm(), 1e-12);
    for (std::size_t kind = 0; kind < 4; ++kind) {
      EXPECT_GT(before[kind], 0);
      EXPECT_NEAR(corners(mesh)[kind], before[kind], 1e-12) << kind;
    }
  }
}

TEST(Mesh, FlippingTwiceIsNothing) {
  const Mesh mesh = testing::one_of_each();
  Mesh flipped = mesh;
  flip_orientation(flipped);
  for (const double corner : corners(flipped)) EXPECT_LT(corner, 0);
  flip_orientation(flipped);
  EXPECT_EQ(flipped.tets.nodes, mesh.tets.nodes);
  EXPECT_EQ(flipped.pyramids.nodes, mesh.pyramids.nodes);
  EXPECT_EQ(flipped.wedges.nodes, mesh.wedges.nodes);
  EXPECT_EQ(flipped.hexes.nodes, mesh.hexes.nodes);
}

TEST(Mesh, LabelsAreAscendingAndDistinct) {
  Mesh mesh;
  for (const Label label : {7, 7, -3, 7}) mesh.tets.add({0, 1, 2, 3}, label);
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, -3);
  mesh.pyramids.add({0, 1, 2, 3, 4}, 0);
  EXPECT_EQ(labels_of(mesh), (std::vector<Label>{-3, 0, 7}));
  EXPECT_TRUE(labels_of(Mesh{}).empty());
}

}  // namespace
}  // namespace cbc3d

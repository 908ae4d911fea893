#include "metrics/hanging_vertices.hpp"

#include <gtest/gtest.h>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

CountedFault hanging(const Mesh& mesh) {
  const LabelImage image = test::empty_image({3, 3, 3}, {1, 1, 1}, {0, 1});
  const MeshView view(mesh, image);
  return count_hanging_vertices(view, extract_surface(view, sorted_facets(view)));
}

/// One tet above the plane z = 0, beside it the two halves of another one below, split at the middle of the
/// edge 0 1.
Mesh edge_against_two_halves(bool split) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 0, -2}, {1, 0, 0}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  if (split) {
    mesh.tets.add({0, 2, 5, 4}, 1);
    mesh.tets.add({5, 2, 1, 4}, 1);
  } else {
    mesh.tets.add({0, 2, 1, 4}, 1);
  }
  return mesh;
}

TEST(HangingVertices, AVertexOnANeighboursEdgeIsOne) {
  const CountedFault fault = hanging(edge_against_two_halves(true));
  EXPECT_EQ(fault.count, 1);
  EXPECT_EQ(fault.first, 5U);
}

TEST(HangingVertices, AConformingMeshHasNone) {
  EXPECT_EQ(hanging(edge_against_two_halves(false)).count, 0);
  EXPECT_EQ(hanging(test::bcc_block(3, 1, 1)).count, 0);
}

}  // namespace
}  // namespace cbc3d::metrics

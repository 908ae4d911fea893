// Quadratic tets share the nodes of their edges, which lie in the middle.
#include "mesher/topology/quadratic_mesh.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d {
namespace {

TEST(QuadraticMesh, HasANodeInTheMiddleOfEveryEdge) {
  const testing::KuhnBox box(2);
  Mesh mesh;
  mesh.points = box.points;
  for (std::size_t t = 0; t < box.tets.size(); ++t) mesh.tets.add(box.tets[t], static_cast<Label>(t % 3));
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  EXPECT_EQ(quadratic.corners, 27U);
  EXPECT_EQ(quadratic.points.size(), 125U) << "the lattice of half the spacing";
  EXPECT_EQ(quadratic.edges.size(), 98U);
  EXPECT_EQ(quadratic.tets.labels, mesh.tets.labels);
  EXPECT_EQ(corner_mesh(quadratic).points, mesh.points);
  EXPECT_EQ(corner_mesh(quadratic).tets.nodes, mesh.tets.nodes);
  for (const auto& tet : quadratic.tets.nodes) {
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = kQuadraticTetEdges[e];
      EXPECT_EQ(quadratic.points[tet[4 + e]], 0.5 * (quadratic.points[tet[a]] + quadratic.points[tet[b]]));
    }
  }
}

TEST(QuadraticMesh, RefusesMixedElements) {
  Mesh mesh;
  mesh.points.resize(5);
  mesh.pyramids.add({0, 1, 2, 3, 4}, 1);
  EXPECT_THROW(straight_quadratic_mesh(mesh), InputError);
}

}  // namespace
}  // namespace cbc3d

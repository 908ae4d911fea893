// Edges of a ball's mesh follow its surface, none at a tet's cost.
#include "mesher/quadratic/curved_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/quadratic/tet_jacobian.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// A box's tets, its vertices moved so that it becomes a ball of the image: radius 12 around
/// (15.5, 15.5, 15.5).
MaterialMesh ball_mesh() {
  const testing::KuhnBox box(6);
  MaterialMesh mesh;
  mesh.tets = box.tets;
  mesh.materials.assign(box.tets.size(), 1);
  for (const Vec3& p : box.points) {
    const Vec3 q = p / 3.0 - Vec3{1, 1, 1};
    const double cube = std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
    const Vec3 on_ball = q.norm() > 0 ? q * (cube / q.norm()) : q;
    mesh.points.push_back(Vec3{15.5, 15.5, 15.5} + 12 * (0.7 * on_ball * cube + on_ball * 0.3));
  }
  return mesh;
}

double volume_of(const QuadraticMesh& mesh) {
  double sum = 0;
  for (const auto& tet : mesh.tets.nodes) {
    std::array<Vec3, 10> nodes;
    for (std::size_t n = 0; n < 10; ++n) nodes[n] = mesh.points[tet[n]];
    sum += volume_of_quadratic_tet(nodes);
  }
  return sum;
}

TEST(CurvedMesh, FollowsABall) {
  const LabelImage image = testing::ball_image(32, 1, 12);
  const ImageDomain domain(image);
  const MaterialMesh mesh = ball_mesh();
  CurveReport report;
  const QuadraticMesh curved = curved_quadratic_mesh(mesh, domain, {}, report);
  const QuadraticMesh straight = straight_quadratic_mesh(to_physical_mesh(mesh, image));
  EXPECT_GT(report.curved, report.boundary_edges / 2);
  EXPECT_GE(report.least_jacobian, 0.5);
  const double ball = 4.0 / 3 * M_PI * 12 * 12 * 12;
  EXPECT_LT(std::fabs(volume_of(curved) / ball - 1), 0.6 * std::fabs(volume_of(straight) / ball - 1));
  for (std::size_t v = 0; v < curved.corners; ++v) EXPECT_EQ(curved.points[v], straight.points[v]);
  for (const auto& tet : curved.tets.nodes) {
    std::array<Vec3, 10> nodes;
    for (std::size_t n = 0; n < 10; ++n) nodes[n] = curved.points[tet[n]];
    EXPECT_GE(least_relative_jacobian(nodes), 0.5);
  }
}

TEST(CurvedMesh, NoTetSuffersUnderAStricterBound) {
  const LabelImage image = testing::ball_image(32, 1, 12);
  const ImageDomain domain(image);
  CurveReport loose, strict;
  curved_quadratic_mesh(ball_mesh(), domain, {}, loose);
  curved_quadratic_mesh(ball_mesh(), domain, {.least_jacobian = 0.95}, strict);
  EXPECT_GE(strict.least_jacobian, 0.95);
  EXPECT_GT(strict.held_back + strict.straight, loose.held_back + loose.straight);
}

TEST(CurvedMesh, InsideAndJunctionsStayStraight) {
  const LabelImage image = testing::ball_image(32, 1, 12);
  const ImageDomain domain(image);
  MaterialMesh mesh = ball_mesh();
  CurveReport report;
  const QuadraticMesh curved = curved_quadratic_mesh(mesh, domain, {}, report);
  std::size_t moved = 0;
  for (std::size_t e = 0; e < curved.edges.size(); ++e) {
    const Vec3 middle = 0.5 * (curved.points[curved.edges[e][0]] + curved.points[curved.edges[e][1]]);
    moved += curved.points[curved.corners + e] == middle ? 0 : 1;
  }
  EXPECT_LE(moved, report.boundary_edges);
  EXPECT_GT(moved, 0U);
}

TEST(CurvedMesh, RefusesMixedElements) {
  const LabelImage image = testing::ball_image(32, 1, 12);
  const ImageDomain domain(image);
  MaterialMesh mesh = ball_mesh();
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  CurveReport report;
  EXPECT_THROW(curved_quadratic_mesh(mesh, domain, {}, report), InputError);
}

}  // namespace
}  // namespace cbc3d

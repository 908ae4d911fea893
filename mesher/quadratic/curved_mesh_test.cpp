// Edges of a ball's mesh follow its surface, none at a tet's cost, and its parts keep their volumes.
#include "mesher/quadratic/curved_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/quadratic/tet_jacobian.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"
#include "mesher/topology/interface_facets.hpp"

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

std::vector<double> volumes_of(const QuadraticMesh& mesh) {
  std::vector<double> sums(3);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 10> nodes;
    for (std::size_t n = 0; n < 10; ++n) nodes[n] = mesh.points[mesh.tets.nodes[t][n]];
    sums[static_cast<std::size_t>(mesh.tets.labels[t])] += volume_of_quadratic_tet(nodes);
  }
  return sums;
}

double volume_of(const QuadraticMesh& mesh) {
  const std::vector<double> sums = volumes_of(mesh);
  return sums[1] + sums[2];
}

/// The ball with a core of material 2 about half as wide. Vertices lie beyond the boundaries by as much as
/// gives flat facets the volumes of the image's voxels, as those of the mesher do.
MaterialMesh mesh_of_ball_and_core(const ImageDomain& domain) {
  constexpr double kCore = 7;  // mm; a layer of vertices is at 6.13, the next at 8.87
  const Vec3 centre{15.5, 15.5, 15.5};
  MaterialMesh mesh = ball_mesh();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets[t];
    const auto is_inside = [&](VertexId v) { return (mesh.points[v] - centre).norm() < kCore; };
    mesh.materials[t] = std::all_of(tet.begin(), tet.end(), is_inside) ? 2 : 1;
  }
  const auto flat = volumes_of(straight_quadratic_mesh(to_physical_mesh(mesh, domain.image())));
  const auto& wanted = domain.volumes_mm3();
  const double of_core = std::cbrt(wanted[2] / flat[2]);
  const double of_ball = std::cbrt((wanted[1] + wanted[2]) / (flat[1] + flat[2]));
  for (Vec3& p : mesh.points) p = centre + ((p - centre).norm() < kCore ? of_core : of_ball) * (p - centre);
  return mesh;
}

/// Of the nodes in the middle of boundary edges.
double mean_distance_mm(const QuadraticMesh& mesh, const MaterialMesh& flat, const ImageDomain& domain) {
  double sum = 0, count = 0;
  for (const InterfaceFacet& facet : interface_facets(flat, cells_of_vertices(flat))) {
    for (std::size_t n = 0; n < 3; ++n) {
      const auto [low, high] = std::minmax(facet.nodes[n], facet.nodes[(n + 1) % 3]);
      const auto e = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), std::array{low, high});
      const Vec3& node = mesh.points[mesh.corners + static_cast<std::size_t>(e - mesh.edges.begin())];
      sum += std::fabs(domain.boundary_distance(node, facet.lower, facet.higher).distance_mm);
      ++count;
    }
  }
  return sum / count;
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

TEST(CurvedMesh, EveryPartKeepsItsVolume) {
  const LabelImage image = testing::ball_image(32, 1, 12, 6.13);
  const ImageDomain domain(image);
  const MaterialMesh mesh = mesh_of_ball_and_core(domain);
  CurveReport report;
  const QuadraticMesh curved = curved_quadratic_mesh(mesh, domain, {}, report);
  const QuadraticMesh straight = straight_quadratic_mesh(to_physical_mesh(mesh, image));
  const auto &wanted = domain.volumes_mm3(), of_curved = volumes_of(curved),
             of_straight = volumes_of(straight);
  for (std::size_t m = 1; m <= 2; ++m) {
    EXPECT_NEAR(of_straight[m] / wanted[m], 1, 1e-9);
    EXPECT_NEAR(of_curved[m] / wanted[m], 1, 2e-4);
    EXPECT_NEAR(report.volume_mm3.at(static_cast<Label>(m)), of_curved[m], 1e-9 * of_curved[m]);
  }
  EXPECT_GE(report.least_jacobian, 0.5);
  EXPECT_GT(report.curved, report.boundary_edges / 2);
  EXPECT_LT(mean_distance_mm(curved, mesh, domain), mean_distance_mm(straight, mesh, domain));
}

TEST(CurvedMesh, IsTheSameAtAnyNumberOfThreads) {
  const LabelImage image = testing::ball_image(32, 1, 12, 6.13);
  const ImageDomain domain(image);
  const MaterialMesh mesh = mesh_of_ball_and_core(domain);
  CurveReport report;
  const std::vector<Vec3> expected = curved_quadratic_mesh(mesh, domain, {}, report).points;
  testing::at_thread_counts(
      [&] { EXPECT_EQ(curved_quadratic_mesh(mesh, domain, {}, report).points, expected); });
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

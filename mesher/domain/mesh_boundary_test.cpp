// The boundary that a mesh has, on a box of two layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesher/core/error.hpp"
#include "mesher/domain/mesh_boundary.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

/// Four cubes along each axis, material 1 below z = 2 and 2 above.
MaterialMesh layers() {
  const testing::KuhnBox box(4);
  MaterialMesh mesh{box.points, box.tets, {}, {}, {}};
  for (std::size_t t = 0; t < box.tets.size(); ++t) mesh.materials.push_back(box.centroid(t).z < 2 ? 1 : 2);
  return mesh;
}

TEST(MeshBoundary, IsAPlaneBetweenTheLayers) {
  const MeshBoundary boundary(layers());
  std::mt19937 random(1);
  for (int n = 0; n < 300; ++n) {
    const Vec3 x = testing::draw_point(random, 0, 4);
    const BoundarySample s = boundary.sample(x, 1, 2);
    EXPECT_NEAR(s.distance_mm, 2 - x.z, 1e-12);
    EXPECT_NEAR(s.deviation_mm, std::abs(2 - x.z), 1e-12);
    EXPECT_LT((s.normal - Vec3{0, 0, -1}).norm(), 1e-12);  // towards the first
    EXPECT_EQ(boundary.sample(x, 2, 1).distance_mm, -s.distance_mm);
  }
}

TEST(MeshBoundary, IsTheBoxTowardsTheOutside) {
  const MeshBoundary boundary(layers());
  std::mt19937 random(2);
  for (int n = 0; n < 300; ++n) {
    Vec3 x = testing::draw_point(random, 0.1, 3.9);
    x.z = 0.5 * x.z;
    const BoundarySample s = boundary.sample(x, 1, kBackground);
    EXPECT_NEAR(s.deviation_mm, std::min({x.x, x.y, x.z, 4 - x.x, 4 - x.y}), 1e-12);
    EXPECT_GT(s.distance_mm, 0);
    EXPECT_LE(s.distance_mm, s.deviation_mm + 1e-12);
    EXPECT_LT(boundary.sample(x + Vec3{0, 0, -5}, 1, kBackground).distance_mm, 0);
  }
}

TEST(MeshBoundary, KnowsNothingOfPairsThatDoNotMeet) {
  EXPECT_TRUE(std::isinf(MeshBoundary(layers()).sample({1, 1, 1}, 1, 3).deviation_mm));
}

TEST(MeshBoundary, PointsAreItsVerticesAndCentres) {
  const MaterialMesh mesh = layers();
  const MeshBoundary boundary(mesh);
  EXPECT_NEAR(boundary.mean_edge_mm(), (2 + std::sqrt(2.0)) / 3, 1e-12);
  // Facets: two to a square, 16 squares between, 16 + 4 * 8 around each layer. Vertices: 25 between, and
  // around each layer 25 + 2 * 16.
  const std::size_t facets = 2 * (16 + 2 * (16 + 32));
  const std::size_t vertices = 25 + 2 * (25 + 32);
  ASSERT_EQ(boundary.points().size(), facets + vertices);
  for (const InterfacePoint& p : boundary.points()) {
    EXPECT_GT(p.own, p.other);
    EXPECT_LT(boundary.sample(p.centre(), p.own, p.other).deviation_mm, 1e-6);
  }
  const auto near = boundary.hosts(0);
  const auto all = boundary.hosts(1);
  EXPECT_EQ(static_cast<std::size_t>(std::count(near.begin(), near.end(), kNoVertex)), facets);
  for (std::size_t p = 0; p < all.size(); ++p) {
    ASSERT_NE(all[p], kNoVertex);
    EXPECT_LT((mesh.points[all[p]] - boundary.points()[p].centre()).norm(), 1);
  }
}

TEST(MeshBoundary, AFaceOfThreeTetsIsRefused) {
  MaterialMesh mesh = layers();
  mesh.tets.push_back(mesh.tets[0]);
  mesh.tets.push_back(mesh.tets[0]);
  mesh.materials.insert(mesh.materials.end(), 2, 1);
  EXPECT_THROW(MeshBoundary{mesh}, JobError);
}

}  // namespace
}  // namespace cbc3d

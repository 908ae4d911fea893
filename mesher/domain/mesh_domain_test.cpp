// The surfaces of a mesh as a domain, against the block that they bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesher/core/error.hpp"
#include "mesher/domain/mesh_domain.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d {
namespace {

/// A box of unit cubes, [0, 6]^3: material 1, within [2, 4]^3 material 2.
MaterialMesh block_in_a_box() {
  const testing::KuhnBox box(6);
  MaterialMesh mesh{box.points, box.tets, {}, {}, {}};
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    const Vec3 from_middle = box.centroid(t) - Vec3{3, 3, 3};
    mesh.materials.push_back(
        std::max({std::fabs(from_middle.x), std::fabs(from_middle.y), std::fabs(from_middle.z)}) < 1 ? 2 : 1);
  }
  return mesh;
}

struct Block {
  MaterialMesh mesh = block_in_a_box();
  MeshDomain domain{mesh, {0, 5, 9}};
};

/// Positive within the inner block.
double depth_in_block(const Vec3& x) {
  const double depth = std::min((x - Vec3{2, 2, 2}).min_coeff(), (Vec3{4, 4, 4} - x).min_coeff());
  Vec3 out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = std::max({2 - x[axis], 0.0, x[axis] - 4});
  return depth > 0 ? depth : -out.norm();
}

TEST(MeshDomain, DistancesAreThoseOfTheFacetsSignedTowardsTheFirstMaterial) {
  const Block block;
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = 0.5 + 5 * (random() / 4294967296.0);
    const double depth = depth_in_block(x);
    const BoundaryDistance d = block.domain.boundary_distance(x, 2, 1);
    EXPECT_NEAR(d.deviation_mm, std::fabs(depth), 1e-9);
    if (std::fabs(depth) > 1e-6) {
      EXPECT_EQ(d.distance_mm > 0, depth > 0);
    }
    EXPECT_EQ(block.domain.boundary_distance(x, 1, 2).distance_mm, -d.distance_mm);
  }
  EXPECT_TRUE(std::isinf(block.domain.boundary_distance({3, 3, 3}, 2, 0).deviation_mm));  // they do not meet
}

TEST(MeshDomain, PlacesHaveTheMaterialAndTheNearestBoundaryOfTheMesh) {
  const Block block;
  EXPECT_EQ(block.domain.material_at({3, 3, 3.2}), 2);
  EXPECT_EQ(block.domain.material_at({1.2, 3, 3.1}), 1);
  EXPECT_EQ(block.domain.material_at({-0.5, 3, 3.1}), kBackground);
  const Vec3 nearest = block.domain.nearest_boundary({2.9, 3.1, 3.6}, 2).value_or(Vec3{});
  EXPECT_LT((nearest - Vec3{2.9, 3.1, 4}).norm(), 1e-9);
  EXPECT_TRUE(block.domain.is_near_boundary({2.9, 3.1, 3.6}, 2));
  EXPECT_FALSE(block.domain.nearest_boundary({3, 3, 30}, 1).has_value());
  EXPECT_FALSE(block.domain.is_near_boundary({3, 3, 3}, kBackground));  // three from the outer surface
}

TEST(MeshDomain, VolumesSamplesAndVerticesAreThoseOfTheMesh) {
  const Block block;
  EXPECT_EQ(block.domain.labels(), (std::vector<Label>{0, 5, 9}));
  EXPECT_NEAR(block.domain.volumes_mm3()[1], 208, 1e-9);
  EXPECT_NEAR(block.domain.volumes_mm3()[2], 8, 1e-9);
  EXPECT_EQ(block.domain.volumes_mm3()[0], 0);
  const auto& samples = block.domain.samples();
  // 24 squares inside and 216 outside, two facets each; 26 vertices inside and 218 outside.
  EXPECT_EQ(samples.size(), 2U * (24 + 216) + 26 + 218);
  EXPECT_NEAR(block.domain.scale_mm(), (2 + std::sqrt(2.0)) / 3, 1e-9);
  const std::vector<VertexId> covering = block.domain.covering_vertices(1);
  ASSERT_EQ(covering.size(), samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    ASSERT_NE(covering[s], kNoVertex);
    EXPECT_LE((block.mesh.points[covering[s]] - samples[s].centre()).norm(), 1);
  }
  const auto near = block.domain.covering_vertices(0.1);  // the facets' centres are farther away
  EXPECT_EQ(std::count(near.begin(), near.end(), kNoVertex), 2 * (24 + 216));
}

TEST(MeshDomain, AFaceOfThreeTetsIsRefused) {
  MaterialMesh mesh = block_in_a_box();
  mesh.tets.insert(mesh.tets.end(), 2, mesh.tets[0]);
  mesh.materials.insert(mesh.materials.end(), 2, 1);
  EXPECT_THROW((MeshDomain{mesh, {0, 5, 9}}), JobError);
}

}  // namespace
}  // namespace cbc3d

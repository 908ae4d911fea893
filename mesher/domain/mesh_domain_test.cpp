// The surfaces of a mesh as a domain, against the block that they bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "mesher/domain/mesh_domain.hpp"

namespace cbc3d {
namespace {

/// A box of unit cubes, [0, 6]^3, six tets each: material 1, within [2, 4]^3 material 2.
MaterialMesh block_in_a_box() {
  constexpr int kCubes = 6;
  MaterialMesh mesh;
  const auto vertex = [](int i, int j, int k) {
    return static_cast<VertexId>((k * (kCubes + 1) + j) * (kCubes + 1) + i);
  };
  for (int k = 0; k <= kCubes; ++k) {
    for (int j = 0; j <= kCubes; ++j) {
      for (int i = 0; i <= kCubes; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int cube = 0; cube < kCubes * kCubes * kCubes; ++cube) {
    const Index3 low = {cube % kCubes, cube / kCubes % kCubes, cube / (kCubes * kCubes)};
    const bool inner = std::all_of(low.begin(), low.end(), [](int i) { return i == 2 || i == 3; });
    for (std::size_t o = 0; o < kOrders.size(); ++o) {
      Index3 at = low;
      std::array<VertexId, 4> tet = {vertex(at[0], at[1], at[2])};
      for (std::size_t step = 0; step < 3; ++step) {
        ++at[kOrders[o][step]];
        tet[step + 1] = vertex(at[0], at[1], at[2]);
      }
      if (o >= 3) std::swap(tet[2], tet[3]);  // odd orders are left-handed
      mesh.tets.push_back(tet);
      mesh.materials.push_back(inner ? 2 : 1);
    }
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
  const auto nearest = block.domain.nearest_boundary({2.9, 3.1, 3.6}, 2);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_LT((*nearest - Vec3{2.9, 3.1, 4}).norm(), 1e-9);
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

}  // namespace
}  // namespace cbc3d

// Splits of edges: a known ring, and what stays.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesher/improve/local/edge_split.hpp"
#include "mesher/improve/local/testing_patch.hpp"
#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {
namespace {

const double kGoal = quality_of_deg(30);

TEST(EdgeSplit, ALongEdgeOfFourTetsIsSplitInTheMiddle) {
  const testing::BoundaryEverywhere domain;
  Patch patch = testing::make_patch(testing::tets_around_edge(4, 6), domain);
  const testing::Summary before = testing::summary_of(patch.mesh);
  ASSERT_LT(before.worst_quality, kGoal);
  EXPECT_EQ(split_edges(patch, kGoal), 1U);
  const testing::Summary after = testing::summary_of(patch.mesh);
  EXPECT_EQ(after.tets, 8U);
  EXPECT_NEAR(after.volume_mm3, before.volume_mm3, 1e-9);
  EXPECT_GT(after.worst_quality, before.worst_quality);
  EXPECT_GT(after.worst_sine_squared, 4 * before.worst_sine_squared);
  ASSERT_EQ(patch.mesh.vertex_count(), 7U);
  const Vec3& middle = patch.mesh.point(6);
  EXPECT_LT(std::hypot(middle.x, middle.y), 0.5);
  EXPECT_LT(std::abs(middle.z), 3);
  EXPECT_EQ(patch.sets[6].size, 1);  // the new vertex lies inside its material
  EXPECT_TRUE(patch.sets[6].has(1));
}

TEST(EdgeSplit, GoodTetsAndEdgesBetweenMaterialsStay) {
  const testing::BoundaryEverywhere domain;
  Patch good = testing::make_patch(testing::tets_around_edge(6, 0.7), domain);
  EXPECT_EQ(split_edges(good, kGoal), 0U);
  EXPECT_EQ(good.mesh.vertex_count(), 8U);
  // The same long edge, now where two materials meet.
  const TetComplex whole = testing::tets_around_edge(4, 6);
  std::vector<Vec3> points(whole.vertex_count());
  TetNodes tets(whole.tet_slots());
  for (VertexId v = 0; v < whole.vertex_count(); ++v) points[v] = whole.point(v);
  for (TetId t = 0; t < whole.tet_slots(); ++t) tets[t] = whole.nodes(t);
  Patch parted =
      testing::make_patch(TetComplex(points, tets, {1, 1, 2, 2}, std::vector<std::uint8_t>(6, 0)), domain);
  EXPECT_EQ(split_edges(parted, kGoal), 0U);
  EXPECT_EQ(testing::summary_of(parted.mesh).tets, 4U);
}

}  // namespace
}  // namespace cbc3d

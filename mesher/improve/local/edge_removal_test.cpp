// Removal of edges: a known ring, and what is lifted on a lattice mesh.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/testing_patch.hpp"
#include "mesher/improve/local/testing_trial.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::covered_count;
using testing::expect_sound;
using testing::kGood;
using testing::kRelax;
using testing::Trial;

TEST(EdgeRemoval, ALongEdgeOfThreeTetsMakesRoomForTwo) {
  const testing::BoundaryEverywhere domain;
  Patch patch = testing::make_patch(testing::tets_around_edge(3, 3), domain);
  const testing::Summary before = testing::summary_of(patch.mesh);
  EXPECT_EQ(remove_edges(patch, kGood), 1U);
  const testing::Summary after = testing::summary_of(patch.mesh);
  EXPECT_EQ(after.tets, 2U);
  EXPECT_NEAR(after.volume_mm3, before.volume_mm3, 1e-12);
  EXPECT_LT(before.worst_quality, kGood);
  EXPECT_GT(after.worst_quality, kGood);
  EdgeRing ring;
  EXPECT_FALSE(patch.mesh.ring(0, 1, ring));  // the edge is gone
  EXPECT_EQ(remove_edges(patch, kGood), 0U);
}

TEST(EdgeRemoval, AGoodEdgeStays) {
  const testing::BoundaryEverywhere domain;
  Patch patch = testing::make_patch(testing::tets_around_edge(6, 0.7), domain);
  ASSERT_GT(testing::summary_of(patch.mesh).worst_quality, kGood);
  EXPECT_EQ(remove_edges(patch, kGood), 0U);
  EXPECT_EQ(testing::summary_of(patch.mesh).tets, 6U);
}

TEST(EdgeRemoval, KeepsALatticeMeshSoundAndItsWorstAngle) {
  Trial trial(testing::touching_balls());
  trial.apply([](Patch& p) { relax_vertices(p, kRelax); });
  const double worst = trial.worst_quality();
  const std::size_t covered = covered_count(trial);
  std::size_t removed = 0;
  trial.apply([&](Patch& p) { removed += remove_edges(p, kGood); });
  EXPECT_GT(removed, 10U);
  EXPECT_GE(trial.worst_quality(), worst);
  expect_sound(trial, covered);
}

}  // namespace
}  // namespace cbc3d

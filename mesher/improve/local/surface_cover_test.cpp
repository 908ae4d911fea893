// Which surface vertex stands for which boundary voxel while vertices move and merge.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "mesher/improve/local/surface_cover.hpp"

namespace cbc3d {
namespace {

TEST(SurfaceCover, SamplesPassToVerticesWithinReachOrStay) {
  const std::vector<BoundarySample> points = {{{0, 0, 0}, 1, 0}, {{1, 0, 0}, 1, 0}};
  const TetComplex mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {1}, {0, 0, 0, 0});
  std::vector<MaterialSet> sets(4);
  for (MaterialSet& set : sets) {
    set.add(0);
    set.add(1);
  }
  const auto points_of = [](const SurfaceCover& cover, VertexId v) {
    std::set<SampleId> found;
    cover.for_each(v, [&](SampleId p) { found.insert(p); });
    return found;
  };
  SurfaceCover cover(points, 1.05);
  cover.resize(4);
  cover.add(0, 0);
  cover.add(0, 1);
  const std::array<VertexId, 1> far = {2};
  const std::array<VertexId, 2> near = {2, 1};
  const Vec3 step = {0, 0, 0.2};
  const Vec3 away = {-0.5, 0, 0};
  EXPECT_FALSE(cover.can_release(0, nullptr, far, mesh, sets));  // point 1 is 1.4 from vertex 2
  EXPECT_TRUE(cover.can_release(0, &step, {}, mesh, sets));
  cover.commit(0);
  EXPECT_EQ(points_of(cover, 0), (std::set<SampleId>{0, 1}));
  EXPECT_FALSE(cover.can_release(0, &away, far, mesh, sets));
  ASSERT_TRUE(cover.can_release(0, &away, near, mesh, sets));
  cover.commit(0);
  EXPECT_EQ(points_of(cover, 0), (std::set<SampleId>{0}));
  EXPECT_EQ(points_of(cover, 1), (std::set<SampleId>{1}));
  sets[1] = {};  // not on the interface any more: it covers nothing
  EXPECT_FALSE(cover.can_release(0, nullptr, std::array<VertexId, 1>{1}, mesh, sets));
  sets[2] = {};
  EXPECT_FALSE(cover.can_release(0, nullptr, near, mesh, sets));
}

TEST(SurfaceCover, WhatNoneAroundCoversGoesToTheOneThatStays) {
  // A row of points; vertices 0 and 1 become one, 2 and 3 are to their left and right.
  std::vector<BoundarySample> points;
  points.reserve(7);
  for (int i = 0; i < 7; ++i) points.push_back({{1.0F * static_cast<float>(i), 0, 0}, 1, 0});
  const TetComplex mesh({{2, 0, 0}, {4, 0, 0}, {0, 0, 0}, {6, 0, 0}}, {}, {}, {0, 0, 0, 0});
  std::vector<MaterialSet> sets(4);
  for (MaterialSet& set : sets) {
    set.add(0);
    set.add(1);
  }
  SurfaceCover cover(points, 1.1);
  cover.resize(4);
  for (const SampleId p : {1U, 2U, 3U}) cover.add(0, p);
  for (const SampleId p : {4U, 5U}) cover.add(1, p);
  const std::array<VertexId, 2> others = {2, 3};
  EXPECT_TRUE(cover.find_uncovered(0, 1, others, mesh, sets));
  EXPECT_EQ(std::set<SampleId>(cover.uncovered().begin(), cover.uncovered().end()),
            (std::set<SampleId>{2, 3, 4}));
  cover.commit_merge(0, 1);
  const std::array<std::set<SampleId>, 4> expected = {{{}, {2, 3, 4}, {1}, {5}}};
  for (VertexId v = 0; v < 4; ++v) {
    std::set<SampleId> found;
    cover.for_each(v, [&](SampleId p) { found.insert(p); });
    EXPECT_EQ(found, expected[v]) << v;
  }
  sets[2] = {};  // it covers nothing any more
  EXPECT_FALSE(cover.find_uncovered(2, 3, std::array<VertexId, 1>{2}, mesh, sets));  // they are 4 apart
}

TEST(SurfaceCover, OfAWholeMeshMovesWithinTheLimitAndReassigns) {
  const std::vector<BoundarySample> samples = {{{0, 0, 0}, 1, 0}, {{1, 0, 0}, 1, 0}, {{3, 0, 0}, 1, 0}};
  SurfaceCover cover(samples, {0, 0, kNoVertex}, 2, 1.0);
  EXPECT_TRUE(cover.may_move(0, {0.5, 0, 0}, {0.9, 0, 0}));
  EXPECT_FALSE(cover.may_move(0, {0.5, 0, 0}, {1.2, 0, 0}));  // beyond the reach of the first
  EXPECT_TRUE(cover.may_move(0, {1.5, 0, 0}, {1.4, 0, 0}));   // beyond it before, and nearer
  EXPECT_TRUE(cover.may_move(1, {0, 0, 0}, {50, 0, 0}));      // covers nothing
  cover.reassign(0, 0, 1);
  std::set<SampleId> first;
  std::set<SampleId> second;
  cover.for_each(0, [&](SampleId s) { first.insert(s); });
  cover.for_each(1, [&](SampleId s) { second.insert(s); });
  EXPECT_EQ(first, std::set<SampleId>{1});
  EXPECT_EQ(second, std::set<SampleId>{0});
}

}  // namespace
}  // namespace cbc3d

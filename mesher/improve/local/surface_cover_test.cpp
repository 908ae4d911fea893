// Which surface vertex stands for which boundary voxel while vertices move and merge.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "mesher/improve/local/surface_cover.hpp"

namespace cbc3d {
namespace {

TEST(SurfaceCover, PointsGoToHostsWithinReachOrStay) {
  const std::vector<InterfacePoint> points = {{{0, 0, 0}, 1, 0}, {{1, 0, 0}, 1, 0}};
  const TetComplex mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {1}, {0, 0, 0, 0});
  std::vector<MaterialSet> sets(4);
  for (MaterialSet& set : sets) {
    set.add(0);
    set.add(1);
  }
  const auto points_of = [](const SurfaceCover& cover, VertexId v) {
    std::set<PointId> found;
    cover.for_each(v, [&](PointId p) { found.insert(p); });
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
  EXPECT_EQ(points_of(cover, 0), (std::set<PointId>{0, 1}));
  EXPECT_FALSE(cover.can_release(0, &away, far, mesh, sets));
  ASSERT_TRUE(cover.can_release(0, &away, near, mesh, sets));
  cover.commit(0);
  EXPECT_EQ(points_of(cover, 0), (std::set<PointId>{0}));
  EXPECT_EQ(points_of(cover, 1), (std::set<PointId>{1}));
  sets[1] = {};  // not on the interface any more: no host
  EXPECT_FALSE(cover.can_release(0, nullptr, std::array<VertexId, 1>{1}, mesh, sets));
  sets[2] = {};
  EXPECT_FALSE(cover.can_release(0, nullptr, near, mesh, sets));
}

TEST(SurfaceCover, WhatNoneAroundReachesIsStrandedAndGoesToTheOneThatStays) {
  // A row of points; vertices 0 and 1 become one, 2 and 3 are to their left and right.
  std::vector<InterfacePoint> points;
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
  for (const PointId p : {1U, 2U, 3U}) cover.add(0, p);
  for (const PointId p : {4U, 5U}) cover.add(1, p);
  const std::array<VertexId, 2> others = {2, 3};
  EXPECT_TRUE(cover.find_stranded(0, 1, others, mesh, sets));
  EXPECT_EQ(std::set<PointId>(cover.stranded().begin(), cover.stranded().end()),
            (std::set<PointId>{2, 3, 4}));
  cover.commit_merge(0, 1);
  const std::array<std::set<PointId>, 4> expected = {{{}, {2, 3, 4}, {1}, {5}}};
  for (VertexId v = 0; v < 4; ++v) {
    std::set<PointId> found;
    cover.for_each(v, [&](PointId p) { found.insert(p); });
    EXPECT_EQ(found, expected[v]) << v;
  }
  sets[2] = {};                                                                     // no host any more
  EXPECT_FALSE(cover.find_stranded(2, 3, std::array<VertexId, 1>{2}, mesh, sets));  // they are 4 apart
}

}  // namespace
}  // namespace cbc3d

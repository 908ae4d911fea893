// Facets that cross or fold, and how many are found.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d {
namespace {

TEST(IntersectingFacets, WhatLiesInOnePlaneCrossesOnlyWhereItOverlaps) {
  const auto pairs = [](const Vec3& shift) {
    std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    for (int i = 0; i < 3; ++i) points.push_back(points[static_cast<std::size_t>(i)] + shift);
    return intersecting_facets(points, {{0, 1, 2}, {3, 4, 5}}).size();
  };
  EXPECT_EQ(pairs({0.3, 0.3, 0}), 1U);  // one over the other
  EXPECT_EQ(pairs({2, 0, 0}), 0U);      // corner at corner
  EXPECT_EQ(pairs({5, 0, 0}), 0U);
  EXPECT_EQ(pairs({0.3, 0.3, 1}), 0U);  // above
  EXPECT_EQ(
      intersecting_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, -2, 0}}, {{0, 1, 2}, {0, 3, 4}})
          .size(),
      0U);  // about one vertex
  EXPECT_EQ(
      intersecting_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, -1, 0}}, {{0, 1, 2}, {0, 3, 4}})
          .size(),
      1U);
  EXPECT_EQ(intersecting_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {9, 9, 0}},
                                {{0, 1, 2}, {3, 4, 5}})
                .size(),
            1U);  // through
}

TEST(FacetsFold, WhereOneLiesInTheTetBehindTheOther) {
  // Facet 0 1 2 with the tet's vertex 3 below it, and facets at edge 0 1 whose tets lie on their far side.
  std::vector<Vec3> points = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {0, 0.5, -1}, {}, {}};
  const auto fold = [&](const Vec3& to, const Vec3& behind) {
    points[4] = to;
    points[5] = behind;
    return facets_fold(points, {0, 1, 2}, 3, {0, 1, 4}, 5);
  };
  EXPECT_FALSE(fold({-1, 0.5, 0.5}, {-1, 0.5, -0.5}));
  EXPECT_FALSE(fold({0.5, 0.5, 0.1}, {-1, 0.5, 0.5}));            // a narrow gap between the two
  EXPECT_TRUE(fold({0.5, 0.5, -0.1}, {-1, 0.5, 0.5}));            // none: one within the other's tet
  EXPECT_TRUE(fold({-1, 0.5, 1}, {1, 0.5, -0.1}));                // likewise with the roles exchanged
  EXPECT_FALSE(facets_fold(points, {0, 1, 2}, 3, {0, 1, 3}, 2));  // two facets of one tet
  EXPECT_FALSE(facets_fold(points, {0, 1, 2}, 3, {0, 4, 5}, 1));  // one vertex in common
}

/// Six tets around the edge 0, 1 that together fill a given angle.
MaterialMesh fan(double turn_deg) {
  MaterialMesh mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < 7; ++i) {
    const double angle = turn_deg / 6 * i * std::numbers::pi / 180;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (VertexId i = 0; i < 6; ++i) {
    mesh.tets.push_back({0, 1, 2 + i, 3 + i});
    mesh.materials.push_back(1);
  }
  return mesh;
}

TEST(SeparateSelfIntersections, AnEdgeWithMoreThanAFullTurnOfTetsIsCounted) {
  for (const double turn_deg : {300.0, 355.0, 365.0, 420.0}) {
    MaterialMesh mesh = fan(turn_deg);
    ASSERT_EQ(testing::inverted_tets(mesh.tets, mesh.points), 0U);
    std::vector<std::array<VertexId, 3>> outside = {{0, 1, 2}, {0, 1, 8}};
    for (VertexId i = 0; i < 6; ++i) {
      outside.push_back({0, 2 + i, 3 + i});
      outside.push_back({1, 2 + i, 3 + i});
    }
    const std::vector<BoundarySample> none;
    std::vector<VertexId> covering;
    SurfaceCover cover(none, covering, mesh.points.size(), 1);
    const std::size_t left =
        separate_self_intersections(mesh, cover, {.step_mm = 0.1, .goal_quality = 0, .rounds = 0});
    EXPECT_EQ(left, intersecting_facets(mesh.points, outside).size() + (turn_deg > 360 ? 1 : 0)) << turn_deg;
  }
}

}  // namespace
}  // namespace cbc3d

// The last steps of the improvement: tets that change hands, volumes that are balanced.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/surface/relabel_tets.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/improve/surface/volume_correction.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::faults;
using testing::open_gap;
using testing::plane_at;
using testing::two_layers;

const std::vector<InterfacePoint> kNoPoints;

/// No step of a vertex is long enough to mend a spike.
RelabelOptions short_steps() {
  RelabelOptions options;
  options.reach_mm = 0.5;
  return options;
}

/// Tets of material 2 on the plane z = 2 with a single vertex above it, no two of them near each other.
std::vector<TetId> make_spikes(MaterialMesh& mesh) {
  std::vector<TetId> spikes;
  std::vector<std::uint8_t> taken(mesh.points.size(), 0);
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    const auto on_plane =
        std::count_if(n.begin(), n.end(), [&](VertexId v) { return mesh.points[v].z == 2; });
    const bool inside = std::all_of(n.begin(), n.end(), [&](VertexId v) {
      const Vec3& p = mesh.points[v];
      return std::min({p.x, p.y, p.z, 5 - p.x, 5 - p.y, 5 - p.z}) > 0.5 && taken[v] == 0;
    });
    if (mesh.materials[t] == 2 && on_plane == 3 && inside) {
      spikes.push_back(t);
      mesh.materials[t] = 1;
      for (const VertexId v : n) taken[v] = 1;
    }
  }
  return spikes;
}

TEST(RelabelTets, SpikesGoBackToWhatTheImageHasThere) {
  const MaterialMesh clean = two_layers(5, 2);
  MaterialMesh mesh = clean;
  const std::vector<TetId> spikes = make_spikes(mesh);
  ASSERT_GE(spikes.size(), 2U);
  ASSERT_EQ(faults(mesh), 0U);
  std::vector<VertexId> hosts;
  CoveredSamples hosted(kNoPoints, hosts, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, hosted, plane_at(5, 2, 0.5), short_steps());
  EXPECT_EQ(report.strays, spikes.size());
  EXPECT_EQ(report.tets_relabelled, spikes.size());
  EXPECT_EQ(mesh.materials, clean.materials);
  EXPECT_EQ(mesh.points[7].x, clean.points[7].x);
}

TEST(RelabelTets, ASpikeThatABoundaryVoxelNeedsStays) {
  MaterialMesh mesh = two_layers(5, 2);
  const std::vector<TetId> spikes = make_spikes(mesh);
  ASSERT_GE(spikes.size(), 2U);
  const auto& kept = mesh.tets[spikes[0]];
  const VertexId tip = *std::max_element(
      kept.begin(), kept.end(), [&](VertexId a, VertexId b) { return mesh.points[a].z < mesh.points[b].z; });
  const Vec3 at = mesh.points[tip];
  const std::vector<InterfacePoint> points = {
      {{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)}, 1, 2}};
  std::vector<VertexId> hosts = {tip};
  CoveredSamples hosted(points, hosts, mesh.points.size(), 0.5);
  const RelabelReport report = relabel_misplaced_tets(mesh, hosted, plane_at(5, 2, 0.5), short_steps());
  EXPECT_EQ(mesh.materials[spikes[0]], 1);
  EXPECT_EQ(report.tets_relabelled, spikes.size() - 1);
  EXPECT_EQ(hosts[0], tip);
}

TEST(RelabelTets, AStepMendsAVertexThatIsHardlyTooFar) {
  MaterialMesh mesh = two_layers(5, 2);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.points[v].z == 2) mesh.points[v].z += v % 7 == 0 ? 0.12 : 0.05;
  }
  std::vector<VertexId> hosts;
  CoveredSamples hosted(kNoPoints, hosts, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, hosted, plane_at(5, 2, 0.1), {});
  EXPECT_GT(report.strays, 0U);
  EXPECT_EQ(report.vertices_moved, report.strays);
  EXPECT_EQ(report.tets_relabelled, 0U);
  for (const Vec3& p : mesh.points) {
    if (p.z > 1.5 && p.z < 2.5 && std::min({p.x, p.y, 5 - p.x, 5 - p.y}) > 0) {
      EXPECT_LE(std::fabs(p.z - 2), 0.1);
    }
  }
}

TEST(RelabelTets, APinchedEdgeIsMended) {
  MaterialMesh mesh = two_layers(4, 2);
  // Two more tets of label 1 above the plane that share an edge with each other, and no face.
  bool found = false;
  for (TetId a = 0; a < mesh.tets.size() && !found; ++a) {
    for (TetId b = a + 1; b < mesh.tets.size() && !found; ++b) {
      MaterialMesh trial = mesh;
      trial.materials[a] = trial.materials[b] = 1;
      if (mesh.materials[a] == 2 && mesh.materials[b] == 2 && faults(trial) > 0) {
        mesh = trial;
        found = true;
      }
    }
  }
  ASSERT_TRUE(found);
  std::vector<VertexId> hosts;
  CoveredSamples hosted(kNoPoints, hosts, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, hosted, plane_at(4, 2, 10), {});
  EXPECT_GT(report.pinches, 0U);
  EXPECT_GT(report.tets_relabelled, 0U);
  EXPECT_EQ(faults(mesh), 0U);
}

TEST(RelabelTets, ATipAcrossAGapIsLeftOut) {
  MaterialMesh mesh = two_layers(6, 2);
  open_gap(mesh, 6, {3.3, 3.2, 3.3});
  const std::size_t kept = mesh.tets.size();
  std::vector<VertexId> hosts;
  CoveredSamples hosted(kNoPoints, hosts, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, hosted, plane_at(6, 2.5, 10), {});
  EXPECT_GT(report.crossings, 0U);
  EXPECT_GT(report.tets_relabelled, 0U);
  EXPECT_EQ(mesh.tets.size(), kept - report.tets_relabelled);  // out of the mesh
  EXPECT_EQ(faults(mesh), 0U);
  EXPECT_EQ(separate_crossings(mesh, hosted, {0.1, 0, 0}), 0U);
}

/// Six tets round the edge 0, 1 that together fill so many degrees.
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

TEST(SeparateCrossings, AnEdgeWithMoreThanAFullTurnOfTetsIsCounted) {
  for (const double turn_deg : {300.0, 355.0, 365.0, 420.0}) {
    MaterialMesh mesh = fan(turn_deg);
    ASSERT_EQ(testing::inverted_tets(mesh.tets, mesh.points), 0U);
    std::vector<std::array<VertexId, 3>> outside = {{0, 1, 2}, {0, 1, 8}};
    for (VertexId i = 0; i < 6; ++i) {
      outside.push_back({0, 2 + i, 3 + i});
      outside.push_back({1, 2 + i, 3 + i});
    }
    std::vector<VertexId> hosts;
    CoveredSamples hosted(kNoPoints, hosts, mesh.points.size(), 1);
    const std::size_t left = separate_crossings(mesh, hosted, {0.1, 0, 0});
    EXPECT_EQ(left, crossing_facets(mesh.points, outside).size() + (turn_deg > 360 ? 1 : 0)) << turn_deg;
  }
}

TEST(CrossingFacets, WhatLiesInOnePlaneCrossesOnlyWhereItOverlaps) {
  const auto pairs = [](const Vec3& shift) {
    std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    for (int i = 0; i < 3; ++i) points.push_back(points[static_cast<std::size_t>(i)] + shift);
    return crossing_facets(points, {{0, 1, 2}, {3, 4, 5}}).size();
  };
  EXPECT_EQ(pairs({0.3, 0.3, 0}), 1U);  // one over the other
  EXPECT_EQ(pairs({2, 0, 0}), 0U);      // corner at corner
  EXPECT_EQ(pairs({5, 0, 0}), 0U);
  EXPECT_EQ(pairs({0.3, 0.3, 1}), 0U);  // above
  EXPECT_EQ(crossing_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, -2, 0}}, {{0, 1, 2}, {0, 3, 4}})
                .size(),
            0U);  // about one vertex
  EXPECT_EQ(crossing_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, -1, 0}}, {{0, 1, 2}, {0, 3, 4}})
                .size(),
            1U);
  EXPECT_EQ(crossing_facets({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {9, 9, 0}},
                            {{0, 1, 2}, {3, 4, 5}})
                .size(),
            1U);  // through
}

TEST(VolumeBalance, MovesTheInterfaceUntilTheVolumesAreRight) {
  MaterialMesh mesh = two_layers(5, 2);
  std::mt19937 random(5);
  for (Vec3& p : mesh.points) {
    if (p.z == 2) p.z += 0.1 * (random() / 4294967296.0 - 0.5);
  }
  BalanceOptions options;
  options.label_of = {0, 1, 2};
  options.wanted_mm3 = {0, 51.5, 73.5};
  std::vector<VertexId> hosts;
  const CoveredSamples free(kNoPoints, hosts, mesh.points.size(), 1);
  MaterialMesh balanced = mesh;
  balance_volumes(balanced, free, options);
  const Extent extent = extent_of_materials(balanced, 3);
  EXPECT_NEAR(extent.volume_mm3[1], 51.5, 51.5 * options.tolerance);
  EXPECT_NEAR(extent.volume_mm3[2], 73.5, 73.5 * options.tolerance);
  EXPECT_GT(std::fabs(extent_of_materials(mesh, 3).volume_mm3[1] - 51.5), 0.5);  // it was not so before

  // With a point on every vertex, and no leeway, nothing moves.
  std::vector<InterfacePoint> points;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    points.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, 1, 2});
    hosts.push_back(v);
  }
  MaterialMesh held = mesh;
  balance_volumes(held, CoveredSamples(points, hosts, mesh.points.size(), 1e-3), options);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    EXPECT_LE((held.points[v] - mesh.points[v]).norm(), 1.1e-3);
  }
}

TEST(VolumeBalance, KeepsTheGoalOfTheAngles) {
  MaterialMesh mesh = two_layers(5, 2);
  BalanceOptions options;
  options.label_of = {0, 1, 2};
  options.wanted_mm3 = {0, 70, 55};
  options.goal_sine_squared = sine_squared_of_deg(40);
  std::vector<VertexId> hosts;
  balance_volumes(mesh, CoveredSamples(kNoPoints, hosts, mesh.points.size(), 1), options);
  for (const auto& n : mesh.tets) {
    EXPECT_GE(min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]),
              options.goal_sine_squared);
  }
}

TEST(NearestBoundaryVoxel, IsThatOfAFullSearch) {
  std::mt19937 random(3);
  const LabelImage image = testing::make_image({9, 8, 7}, {1, 0.7, 1.6}, 4, [&](const Vec3&) {
    return random() % 3 == 0 ? static_cast<int>(random() % 4) : 1;
  });
  int found = 0;
  for (int n = 0; n < 400; ++n) {
    const auto draw = [&](double size) { return size * 1.2 * (random() / 4294967296.0) - 1; };
    const Vec3 at = {draw(9 * image.frame.spacing_mm.x), draw(8 * image.frame.spacing_mm.y),
                     draw(7 * image.frame.spacing_mm.z)};
    const auto m = static_cast<MaterialId>(n % 4);
    const double reach = 0.3 + 0.01 * n;
    double least = reach * reach;
    bool any = false;
    for (int k = 0; k < 7; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 9; ++i) {
          const auto beside = [&](int di, int dj, int dk) {
            return image.at_or_background(i + di, j + dj, k + dk);
          };
          const std::array<MaterialId, 6> around = {beside(1, 0, 0),  beside(-1, 0, 0), beside(0, 1, 0),
                                                    beside(0, -1, 0), beside(0, 0, 1),  beside(0, 0, -1)};
          const MaterialId own = image.at(i, j, k);
          const bool counts = m == kBackground ? own != kBackground &&
                                                     std::count(around.begin(), around.end(), kBackground) > 0
                                               : own == m && std::count(around.begin(), around.end(), m) < 6;
          const double d = (image.frame.local_centre(i, j, k) - at).squared_norm();
          if (counts && d <= least) {
            least = d;
            any = true;
          }
        }
      }
    }
    const auto got = nearest_boundary_voxel(image, at, m, reach);
    ASSERT_EQ(got.has_value(), any);
    EXPECT_EQ(has_boundary_voxel_near(image, at, m, reach), any);
    if (any) {
      EXPECT_NEAR((*got - at).squared_norm(), least, 1e-12);
    }
    found += any ? 1 : 0;
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 390);
}

}  // namespace
}  // namespace cbc3d

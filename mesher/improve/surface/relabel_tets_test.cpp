// Tets that are relabelled where a surface is misplaced, pinched or cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesher/improve/surface/relabel_tets.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"

namespace cbc3d {
namespace {

using testing::faults;
using testing::open_gap;
using testing::plane_at;
using testing::two_layers;

const std::vector<BoundarySample> kNoSamples;

/// No step of a vertex is long enough to mend a spike.
RelabelOptions short_steps() {
  RelabelOptions options;
  options.step_mm = 0.5;
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
  std::vector<VertexId> covering;
  SurfaceCover cover(kNoSamples, covering, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, cover, plane_at(5, 2, 0.5), short_steps());
  EXPECT_EQ(report.far_vertices, spikes.size());
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
  const std::vector<BoundarySample> points = {
      {{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)}, 1, 2}};
  std::vector<VertexId> covering = {tip};
  SurfaceCover cover(points, covering, mesh.points.size(), 0.5);
  const RelabelReport report = relabel_misplaced_tets(mesh, cover, plane_at(5, 2, 0.5), short_steps());
  EXPECT_EQ(mesh.materials[spikes[0]], 1);
  EXPECT_EQ(report.tets_relabelled, spikes.size() - 1);
  EXPECT_FALSE(cover.all_of(tip, [](SampleId) { return false; }));  // it still covers the sample
}

TEST(RelabelTets, AStepMendsAVertexThatIsHardlyTooFar) {
  MaterialMesh mesh = two_layers(5, 2);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (mesh.points[v].z == 2) mesh.points[v].z += v % 7 == 0 ? 0.12 : 0.05;
  }
  std::vector<VertexId> covering;
  SurfaceCover cover(kNoSamples, covering, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, cover, plane_at(5, 2, 0.1), {});
  EXPECT_GT(report.far_vertices, 0U);
  EXPECT_EQ(report.vertices_moved, report.far_vertices);
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
  std::vector<VertexId> covering;
  SurfaceCover cover(kNoSamples, covering, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, cover, plane_at(4, 2, 10), {});
  EXPECT_GT(report.pinches, 0U);
  EXPECT_GT(report.tets_relabelled, 0U);
  EXPECT_EQ(faults(mesh), 0U);
}

TEST(RelabelTets, ATipAcrossAGapIsLeftOut) {
  MaterialMesh mesh = two_layers(6, 2);
  open_gap(mesh, 6, {3.3, 3.2, 3.3});
  const std::size_t kept = mesh.tets.size();
  std::vector<VertexId> covering;
  SurfaceCover cover(kNoSamples, covering, mesh.points.size(), 1);
  const RelabelReport report = relabel_misplaced_tets(mesh, cover, plane_at(6, 2.5, 10), {});
  EXPECT_GT(report.self_intersections, 0U);
  EXPECT_GT(report.tets_relabelled, 0U);
  EXPECT_EQ(mesh.tets.size(), kept - report.tets_relabelled);  // out of the mesh
  EXPECT_EQ(faults(mesh), 0U);
  EXPECT_EQ(separate_self_intersections(mesh, cover, {.step_mm = 0.1, .goal_quality = 0, .rounds = 0}), 0U);
}

}  // namespace
}  // namespace cbc3d

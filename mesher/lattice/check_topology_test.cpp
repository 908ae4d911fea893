// The topological checks, against a check by facets that shares no code with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/lattice/testing_lattice_mesh.hpp"
#include "mesher/preprocess/clean_image.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {
namespace {

using testing::Faults;

Faults faults_of_material_label(const MaterialMesh& mesh, const LabelImage& image, Label label) {
  std::vector<Label> labels;
  std::transform(mesh.materials.begin(), mesh.materials.end(), std::back_inserter(labels),
                 [&](MaterialId m) { return image.labels[m]; });
  return testing::faults_of_surface(testing::surface_of_label(mesh.tets, labels, label));
}

/// The candidate mesh of the cleaned image, with the checks or without.
MaterialMesh mesh_with_checks(LabelImage& image, bool checks, TopologyReport& report) {
  CleanOptions clean;
  clean.region_tolerance = 0;
  clean_image(image, clean, true);
  RefineOptions refine;
  refine.max_distance_mm = 2 * image.frame.voxel_diagonal_mm();
  refine.finest_spacing_mm = 1;
  refine.topology_checks = checks;
  Lattice lattice = build_bcc_lattice(image, {default_lattice_spacing_mm(image.frame), 0.25});
  CandidateMesh candidate = refine_lattice(lattice, ImageDomain(image), refine, [](int, std::size_t) {}).mesh;
  if (checks) {
    report = check_topology(candidate, local_points(lattice), ImageDomain(image), {.enabled = true});
  }
  return discard_background(local_points(lattice), candidate.tets.nodes, candidate.materials);
}

TEST(CheckTopology, NoiseBecomesManifoldForEveryLabel) {
  std::size_t without = 0;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    LabelImage image = testing::noise_image(16, 0.6, seed);
    TopologyReport report;
    const MaterialMesh rough = mesh_with_checks(image, false, report);
    LabelImage again = testing::noise_image(16, 0.6, seed);
    const MaterialMesh mesh = mesh_with_checks(again, true, report);
    EXPECT_EQ(report.non_manifold_vertices_left, 0U);
    ASSERT_GT(mesh.tets.size(), 1000U);
    for (const Label label : {1, 2}) {
      const Faults before = faults_of_material_label(rough, image, label);
      const Faults after = faults_of_material_label(mesh, again, label);
      without += before.edges + before.vertices;
      EXPECT_EQ(after.edges, 0U) << "seed " << seed << " label " << label;
      EXPECT_EQ(after.vertices, 0U) << "seed " << seed << " label " << label;
    }
    const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
    // The rule of the candidate mesh still holds.
    EXPECT_TRUE(std::all_of(neighbours.begin(), neighbours.end(),
                            [](const auto& n) { return std::count(n.begin(), n.end(), kNoTet) <= 1; }));
  }
  EXPECT_GT(without, 0U);  // there was something to repair
}

/// A fan of unit tets on the axes around the origin, as a candidate mesh with the given materials: octants of
/// a cube cut into one tet each, whose stars at the origin are known.
CandidateMesh octants(const std::array<MaterialId, 8>& materials, std::vector<Vec3>& points) {
  points = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  CandidateMesh mesh;
  for (unsigned o = 0; o < 8; ++o) {
    const VertexId x = (o & 1U) != 0 ? 2 : 1;
    const VertexId y = (o & 2U) != 0 ? 4 : 3;
    const VertexId z = (o & 4U) != 0 ? 6 : 5;
    const bool mirrored = ((o & 1U) + (o >> 1U & 1U) + (o >> 2U & 1U)) % 2 == 1;
    mesh.tets.nodes.push_back(mirrored ? std::array<VertexId, 4>{0, y, x, z}
                                       : std::array<VertexId, 4>{0, x, y, z});
    mesh.tets.parent.push_back(o);
    mesh.tets.green.push_back(0);
    mesh.materials.push_back(materials[o]);
  }
  mesh.neighbours = tet_neighbours(mesh.tets.nodes, points.size());
  return mesh;
}

TEST(CheckTopology, KnownStars) {
  std::vector<Vec3> points;
  const auto bad_at_origin = [&](const std::array<MaterialId, 8>& materials) {
    const CandidateMesh mesh = octants(materials, points);
    const auto bad = non_manifold_vertices(mesh, points.size(), {0, 5, 6});
    return std::find(bad.begin(), bad.end(), 0U) != bad.end();
  };
  EXPECT_FALSE(bad_at_origin({1, 1, 1, 1, 0, 0, 0, 0}));  // a half space
  EXPECT_FALSE(bad_at_origin({1, 0, 0, 0, 0, 0, 0, 0}));  // a corner
  EXPECT_TRUE(bad_at_origin({1, 0, 0, 0, 0, 0, 0, 1}));   // two corners that touch by the vertex
  EXPECT_TRUE(bad_at_origin({1, 0, 0, 1, 0, 0, 0, 0}));   // two that touch by an edge
  EXPECT_TRUE(bad_at_origin({0, 1, 1, 1, 1, 1, 1, 0}));   // the same from inside
  EXPECT_FALSE(bad_at_origin({1, 2, 1, 2, 1, 2, 1, 2}));  // two half spaces
  EXPECT_TRUE(bad_at_origin({1, 2, 2, 1, 2, 1, 1, 2}));   // a checkerboard
}

TEST(CheckTopology, NoiseBecomesManifoldWithoutTheRuleOfOneFaceToo) {
  const LabelImage image = testing::noise_image(14, 0.5, 4);
  const MaterialMesh mesh = testing::lattice_mesh(image);
  for (const Label label : {1, 2}) {
    const Faults faults = faults_of_material_label(mesh, image, label);
    EXPECT_EQ(faults.edges + faults.vertices, 0U) << "label " << label;
  }
  std::ptrdiff_t two = 0;  // tets that the rule would have taken away
  for (const auto& n : tet_neighbours(mesh.tets, mesh.points.size())) {
    two += std::count(n.begin(), n.end(), kNoTet) > 1 ? 1 : 0;
  }
  EXPECT_GT(two, 0);
}

TEST(CheckTopology, TheImageDecidesFirstAtANonManifoldVertex) {
  for (const int there : {0, 1}) {
    const LabelImage image = testing::make_image({3, 3, 3}, {1, 1, 1}, 1, [&](const Vec3&) { return there; });
    std::vector<Vec3> points;
    CandidateMesh mesh = octants({1, 0, 0, 0, 0, 0, 0, 1}, points);
    const TopologyReport report =
        check_topology(mesh, points, ImageDomain(image),
                       {.enabled = true, .one_face_rule = false, .image_passes = 1, .small_component = 0});
    EXPECT_EQ(mesh.materials, std::vector<MaterialId>(8, static_cast<MaterialId>(there)));
    EXPECT_EQ(report.non_manifold_vertices, 1U);
    EXPECT_EQ(report.tets_relabelled, there == 1 ? 6U : 2U);
    EXPECT_EQ(report.non_manifold_vertices_left, 0U);
  }
}

/// A piece of background in a voxel of the label is a crumb; in a voxel of background it is a cavity.
TEST(CheckTopology, CrumbsAreWhatHasNoVoxelOfItsLabel) {
  for (const int there : {0, 1}) {
    const LabelImage image = testing::make_image({3, 3, 3}, {1, 1, 1}, 1, [&](const Vec3&) { return there; });
    std::vector<Vec3> points;
    CandidateMesh mesh = octants({1, 1, 1, 1, 1, 1, 1, 0}, points);
    for (Vec3& p : points) {
      p = p + Vec3{1, 1, 1};
    }
    const TopologyReport report =
        check_topology(mesh, points, ImageDomain(image),
                       {.enabled = true, .one_face_rule = false, .drop_crumbs = true, .small_component = 0});
    // The label has no voxel either where the image is empty, and goes.
    EXPECT_EQ(mesh.materials, std::vector<MaterialId>(8, static_cast<MaterialId>(there)));
    EXPECT_EQ(report.components_removed, 1U);
  }
}

TEST(CheckTopology, SmallComponentsGoAndRegionsStay) {
  // Two balls of label 1 (two regions) far apart: both are components that the image has.
  LabelImage image = testing::make_image({60, 24, 24}, {1, 1, 1}, 1, [](const Vec3& p) {
    return (p - Vec3{14, 12, 12}).norm() < 9 || (p - Vec3{46, 12, 12}).norm() < 2.5 ? 1 : 0;
  });
  TopologyReport report;
  mesh_with_checks(image, true, report);
  ASSERT_EQ(report.labels.size(), 1U);
  EXPECT_EQ(report.labels[0].image_regions, 2U);
  EXPECT_EQ(report.labels[0].components, 2U);
}

}  // namespace
}  // namespace cbc3d

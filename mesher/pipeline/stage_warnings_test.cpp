#include "mesher/pipeline/stage_warnings.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// The one sentence that `warn` appends.
std::string warning_of(const std::function<void(MeshImageReport&)>& warn, MeshImageReport report = {}) {
  warn(report);
  EXPECT_EQ(report.warnings.size(), 1U);
  return report.warnings.empty() ? "" : report.warnings.front();
}

/// Balls of label 4 and one of label 7, of one region each.
LabelImage three_regions() {
  LabelImage image = testing::ball_image(24, 1, 9, 4);
  image.labels = {0, 4, 4, 7};
  return image;
}

MaterialMesh tets_of(const std::vector<MaterialId>& materials) {
  MaterialMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets.assign(materials.size(), {0, 1, 2, 3});
  mesh.materials = materials;
  return mesh;
}

std::vector<std::string> losses_with(const std::vector<MaterialId>& materials) {
  MeshImageReport report;
  warn_of_losses(three_regions(), tets_of(materials), report);
  return report.warnings;
}

TEST(StageWarnings, LostRegionsAndLabelsAreNamed) {
  EXPECT_TRUE(losses_with({1, 2, 3}).empty());
  const auto region = losses_with({1, 3});
  ASSERT_EQ(region.size(), 1U);
  EXPECT_TRUE(region[0].starts_with("1 of 2 regions of label 4 (")) << region[0];
  const auto label = losses_with({1, 2});
  ASSERT_EQ(label.size(), 1U);
  EXPECT_TRUE(label[0].starts_with("label 7 (")) << label[0];
}

TEST(StageWarnings, CleaningSaysWhatItChanged) {
  CleanReport clean;
  MeshImageReport report;
  warn_of_cleaning(clean, report);
  EXPECT_TRUE(report.warnings.empty());
  clean.removed.regions_removed = 3;
  clean.removed.voxels_removed = 12;
  clean.labels = {{.label = 9, .voxels_before = 5, .voxels_after = 0}};
  warn_of_cleaning(clean, report);
  ASSERT_EQ(report.warnings.size(), 2U);
  EXPECT_TRUE(report.warnings[0].starts_with("3 regions (12 voxels)")) << report.warnings[0];
  EXPECT_TRUE(report.warnings[1].starts_with("label 9 (5 voxels) vanished")) << report.warnings[1];
}

TEST(StageWarnings, TopologyOfTheFinishedMeshIsTold) {
  MeshImageReport report;
  report.topology_differences = {{.label = 2, .in_image = {1, 0, 0}, .in_mesh = {2, 1, 0}}};
  EXPECT_TRUE(
      warning_of(warn_of_topology_differences, report)
          .starts_with("label 2 has 1, 0, 0 parts, tunnels, cavities in the cleaned image and 2, 1, 0"));
}

TEST(StageWarnings, DeformationThatStoppedIsTold) {
  MeshImageReport report;
  warn_of_early_stop(report);
  EXPECT_TRUE(report.warnings.empty());
  report.deform.stopped_early = true;
  report.deform.iterations.resize(2);
  EXPECT_NE(warning_of(warn_of_early_stop, report).find("stopped in iteration 2"), std::string::npos);
}

TEST(StageWarnings, UnmetWishesAreTold) {
  MeshImageOptions options;
  options.improve.min_dihedral_deg = 20;
  options.elements = 1000;
  options.mixed = true;
  MeshImageReport report;
  report.improve.min_dihedral_after_deg = 18.5;
  EXPECT_EQ(warning_of([&](MeshImageReport& r) { warn_of_angles(options, r); }, report),
            "the smallest dihedral angle is 18.50 degrees, not 20.00");
  EXPECT_EQ(warning_of([&](MeshImageReport& r) { warn_of_elements(options, 1101, r); }),
            "elements 1000 could not be met: the mesh has 1101");
  EXPECT_TRUE(warning_of([&](MeshImageReport& r) {
                warn_of_missing_hexes(options, r);
              }).starts_with("mixed: the mesh"));
  report.improve.min_dihedral_after_deg = 20;
  report.mix.hexes = 1;
  warn_of_angles(options, report);
  warn_of_elements(options, 1100, report);
  warn_of_missing_hexes(options, report);
  EXPECT_TRUE(report.warnings.empty());
}

}  // namespace
}  // namespace cbc3d

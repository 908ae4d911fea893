#include "mesher/pipeline/mesh_findings.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

/// One tet of label 4 with the volume given.
Mesh tet_of(double volume_mm3) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 6 * volume_mm3}};
  mesh.tets.add({0, 1, 2, 3}, 4);
  return mesh;
}

TEST(MeshFindings, NameVolumesThatAreOff) {
  MeshImageReport report;
  report.clean.labels = {{.label = 4, .voxels_before = 100, .voxels_after = 100}};
  ImageFrame frame;
  frame.spacing_mm = {1, 1, 0.5};
  EXPECT_TRUE(mesh_findings(tet_of(50.5), report, frame).empty());
  const auto larger = mesh_findings(tet_of(55), report, frame);
  ASSERT_EQ(larger.size(), 1U);
  EXPECT_NE(larger[0].find("label 4 is 10.0 % larger"), std::string::npos) << larger[0];
  const auto smaller = mesh_findings(tet_of(45), report, frame);
  ASSERT_EQ(smaller.size(), 1U);
  EXPECT_NE(smaller[0].find("10.0 % smaller"), std::string::npos) << smaller[0];
}

TEST(MeshFindings, OfOrderTwoTheCurvedVolumesCount) {
  MeshImageReport report;
  report.clean.labels = {{.label = 4, .voxels_before = 100, .voxels_after = 100}};
  ImageFrame frame;
  frame.spacing_mm = {1, 1, 1};
  EXPECT_EQ(mesh_findings(tet_of(95), report, frame).size(), 1U);
  report.curve.volume_mm3 = {{4, 100}};
  EXPECT_TRUE(mesh_findings(tet_of(95), report, frame).empty());
  report.curve.volume_mm3 = {{4, 90}};
  EXPECT_EQ(mesh_findings(tet_of(100), report, frame).size(), 1U);
}

TEST(MeshFindings, NameSelfIntersections) {
  MeshImageReport report;
  report.improve.self_intersections_left = 3;
  const auto findings = mesh_findings({}, report, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NE(findings[0].find("3 pairs of facets intersect"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d

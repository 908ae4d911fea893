// Volumes that are corrected by small steps of the interfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/improve/surface/volume_correction.hpp"

namespace cbc3d {
namespace {

using testing::two_layers;

const std::vector<BoundarySample> kNoSamples;

TEST(VolumeCorrection, MovesTheInterfaceUntilTheVolumesAreRight) {
  MaterialMesh mesh = two_layers(5, 2);
  std::mt19937 random(5);
  for (Vec3& p : mesh.points) {
    if (p.z == 2) p.z += 0.1 * (random() / 4294967296.0 - 0.5);
  }
  VolumeCorrectionOptions options;
  options.label_of = {0, 1, 2};
  options.wanted_mm3 = {0, 51.5, 73.5};
  std::vector<VertexId> covering;
  const SurfaceCover free(kNoSamples, covering, mesh.points.size(), 1);
  MaterialMesh balanced = mesh;
  correct_volumes(balanced, free, options);
  const Extent extent = extent_of_materials(balanced, 3);
  EXPECT_NEAR(extent.volume_mm3[1], 51.5, 51.5 * options.tolerance);
  EXPECT_NEAR(extent.volume_mm3[2], 73.5, 73.5 * options.tolerance);
  EXPECT_GT(std::fabs(extent_of_materials(mesh, 3).volume_mm3[1] - 51.5), 0.5);  // it was not so before

  // With a point on every vertex, and no leeway, nothing moves.
  std::vector<BoundarySample> points;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    points.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, 1, 2});
    covering.push_back(v);
  }
  MaterialMesh held = mesh;
  correct_volumes(held, SurfaceCover(points, covering, mesh.points.size(), 1e-3), options);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    EXPECT_LE((held.points[v] - mesh.points[v]).norm(), 1.1e-3);
  }
}

TEST(VolumeCorrection, KeepsTheGoalOfTheAngles) {
  MaterialMesh mesh = two_layers(5, 2);
  VolumeCorrectionOptions options;
  options.label_of = {0, 1, 2};
  options.wanted_mm3 = {0, 70, 55};
  options.goal_quality = quality_of_deg(40);
  std::vector<VertexId> covering;
  correct_volumes(mesh, SurfaceCover(kNoSamples, covering, mesh.points.size(), 1), options);
  for (const auto& n : mesh.tets) {
    EXPECT_GE(tet_quality(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]),
              options.goal_quality);
  }
}

}  // namespace
}  // namespace cbc3d

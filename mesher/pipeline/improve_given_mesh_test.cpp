#include "mesher/pipeline/improve_given_mesh.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/pipeline/mesh_array.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

constexpr double kGoalDeg = 23;

/// The published method's mesh of the image, whose smallest angle is below the goal.
Mesh coarse_mesh(const LabelImage& image) {
  MeshImageReport report;
  return mesh_image(image, preset_options("paper", image.frame), Progress(), report);
}

TEST(ImproveGivenMesh, ReachesTheGoalWithAndWithoutAnImage) {
  const LabelImage image = testing::ball_image(20, 1, 7, 3);
  const Mesh mesh = coarse_mesh(image);
  for (const LabelImage* given : {&image, static_cast<const LabelImage*>(nullptr)}) {
    ImproveGivenMeshOptions options;
    options.improve.min_dihedral_deg = kGoalDeg;
    ImproveGivenMeshReport report;
    const Mesh improved = improve_given_mesh(mesh, given, options, Progress(), report);
    EXPECT_EQ(report.before.tets, mesh.tets.size());
    EXPECT_EQ(report.after.tets, improved.tets.size());
    EXPECT_LT(report.before.min_dihedral_deg, kGoalDeg - 1);
    EXPECT_GE(report.after.min_dihedral_deg, kGoalDeg - 0.01);
    EXPECT_NEAR(testing::smallest_dihedral_deg(improved), report.after.min_dihedral_deg, 1e-6);
    EXPECT_EQ(labels_of(improved), labels_of(mesh));
    EXPECT_GT(report.max_deviation_mm, 0);
    EXPECT_TRUE(report.warnings.empty());
  }
}

TEST(ImproveGivenMesh, ThinsOutWhenAsked) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  const Mesh mesh = coarse_mesh(image);
  ImproveGivenMeshReport repaired, thinned;
  improve_given_mesh(mesh, &image, {}, Progress(), repaired);
  improve_given_mesh(mesh, &image, {.decimate = true}, Progress(), thinned);
  EXPECT_LT(2 * thinned.after.tets, repaired.after.tets);
}

TEST(ImproveGivenMesh, RefusesWhatItCannotTake) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  ImproveGivenMeshReport report;
  EXPECT_THROW(improve_given_mesh({}, &image, {}, Progress(), report), InputError);
  Mesh elsewhere = coarse_mesh(image);
  for (Vec3& point : elsewhere.points) {
    point.x += 1000;
  }
  EXPECT_THROW(improve_given_mesh(elsewhere, &image, {}, Progress(), report), InputError);
}

TEST(ImproveGivenMesh, EndsWhenItsObserverSaysSo) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  ImproveGivenMeshReport report;
  const Progress progress([](std::string_view, double) { return false; });
  EXPECT_THROW(improve_given_mesh(coarse_mesh(image), &image, {}, progress, report), Cancelled);
}

}  // namespace
}  // namespace cbc3d

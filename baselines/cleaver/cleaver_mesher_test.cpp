#include "baselines/cleaver/cleaver_mesher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

using cbc3d::testing::make_image;

CleaverResult run(const LabelImage& image, const CleaverOptions& options = {}) {
  StageClock stages;
  return mesh_with_cleaver(image, options, stages);
}

void expect_good(const Mesh& mesh) {
  EXPECT_EQ(cbc3d::testing::inverted_tets(mesh.tets.nodes, mesh.points), 0U);
  EXPECT_EQ(cbc3d::testing::crowded_faces(mesh.tets.nodes), 0U);
}

TEST(CleaverMesher, ABallHasItsVolumeAndItsAnglesAreWithinTheBounds) {
  const LabelImage image = cbc3d::testing::ball_image(40, 1, 15, 7);
  for (const bool graded : {true, false}) {
    const Mesh mesh = run(image, {.graded = graded}).mesh;
    expect_good(mesh);
    // The blur moves the boundary of a ball inwards by the square of its deviation over the radius.
    const auto ball_volume = [](double radius) { return 4.0 / 3 * M_PI * std::pow(radius - 1 / radius, 3); };
    const double core = ball_volume(7), ball = ball_volume(15);
    EXPECT_NEAR(cbc3d::testing::volume_of(mesh, 2) / core, 1, 0.03);
    EXPECT_NEAR(cbc3d::testing::volume_of(mesh, 1) / (ball - core), 1, 0.03);
    if (!graded) {
      EXPECT_GT(cbc3d::testing::smallest_dihedral_deg(mesh), 2.76);
    }
  }
}

TEST(CleaverMesher, SidesOnTheImagesBorderAreFlat) {
  const LabelImage image = make_image({13, 11, 9}, {1, 1, 1.4}, 1, [](const Vec3&) { return 1; });
  for (const double rate : {1.0, 0.4, 1.7}) {
    const Mesh mesh = run(image, {.sampling_rate = rate}).mesh;
    expect_good(mesh);
    const double box = 13 * 11 * 9 * 1.4;
    EXPECT_NEAR(cbc3d::testing::volume_of(mesh, 1), box, 1e-6 * box);
    for (const Vec3& p : mesh.points) {
      EXPECT_GT(p.min_coeff(), -0.7 - 1e-6);
      EXPECT_LT(p.z, 9 * 1.4 - 0.7 + 1e-6);
    }
  }
}

TEST(CleaverMesher, KeepsALabelOfOneVoxelAndSaysSo) {
  LabelImage image = cbc3d::testing::ball_image(30, 1, 10);
  image.labels.push_back(77);
  image.voxels[image.frame.offset(15, 15, 15)] = 2;
  for (const double rate : {1.0, 0.3}) {
    const CleaverResult result = run(image, {.sampling_rate = rate});
    expect_good(result.mesh);
    EXPECT_EQ(labels_of(result.mesh), (std::vector<Label>{1, 77}));
    ASSERT_FALSE(result.notes.empty());
    EXPECT_NE(result.notes.front().find("77"), std::string::npos);
    // The region in which the mask's trilinear interpolation is above one half is smaller than the voxel.
    EXPECT_GT(cbc3d::testing::volume_of(result.mesh, 77), 0.05);
    EXPECT_LT(cbc3d::testing::volume_of(result.mesh, 77), 1);
  }
}

TEST(CleaverMesher, IsTheSameAtAnyThreadCount) {
  const LabelImage image = cbc3d::testing::noisy_blocks_image(4, 3);
  Mesh first;
  cbc3d::testing::at_thread_counts([&] {
    const Mesh mesh = run(image).mesh;
    if (first.points.empty()) first = mesh;
    EXPECT_EQ(mesh.points, first.points);
    EXPECT_EQ(mesh.tets.nodes, first.tets.nodes);
    EXPECT_EQ(mesh.tets.labels, first.tets.labels);
  });
}

TEST(CleaverMesher, NoiseGivesAGoodMesh) {
  for (std::uint32_t seed = 0; seed < 4; ++seed)
    expect_good(run(cbc3d::testing::noise_image(16, 0.6, seed), {.blur_mm = 0.3}).mesh);
}

TEST(CleaverMesher, RefusesATooWideBlur) {
  EXPECT_THROW(run(cbc3d::testing::ball_image(20, 1, 6), {.blur_mm = 100}), InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

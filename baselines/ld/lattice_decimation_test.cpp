#include "baselines/ld/lattice_decimation.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/core/error.hpp"
#include "mesher/domain/testing_random_image.hpp"
#include "metrics/evaluate_mesh.hpp"

namespace cbc3d::baselines::ld {
namespace {

Mesh meshed(const LabelImage& image, const LatticeDecimationOptions& options) {
  StageClock clock;
  return mesh_by_lattice_decimation(image, options, clock);
}

TEST(LatticeDecimation, ReducesABallByMoreThanTenTimesWithinOneVoxel) {
  const LabelImage image = cbc3d::testing::ball_image(45, 1, 20);
  const CellGrid grid(image, {});
  const std::size_t before = testing::whole_initial_mesh(grid).tets.size();
  const Mesh mesh = meshed(image, {.decimation = {.distances = {1, 1}}});
  EXPECT_LT(10 * mesh.tets.size(), before);
  EXPECT_GE(cbc3d::testing::smallest_dihedral_deg(mesh), 15);
}

TEST(LatticeDecimation, SmallBlocksLeaveNoTraceOnACube) {
  const LabelImage image =
      cbc3d::testing::make_image({20, 20, 20}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
  EXPECT_LE(meshed(image, {.block = 8}).tets.size(), 60U);
}

TEST(LatticeDecimation, GivesTheSameMeshAtAnyThreadCount) {
  const LabelImage image = cbc3d::testing::touching_balls();
  const int before = omp_get_max_threads();
  for (const double distance : {0.0, 1.0}) {
    const LatticeDecimationOptions options{.decimation = {.distances = {distance, distance}}, .block = 8};
    omp_set_num_threads(1);
    const Mesh one = meshed(image, options);
    omp_set_num_threads(3);
    const Mesh three = meshed(image, options);
    EXPECT_EQ(one.points, three.points);
    EXPECT_TRUE(one.tets.nodes == three.tets.nodes);
    EXPECT_EQ(one.tets.labels, three.tets.labels);
  }
  omp_set_num_threads(before);
}

TEST(LatticeDecimation, CountsFallAsBothBoundsGrow) {
  const LabelImage image = cbc3d::testing::cavity_and_torus();
  std::size_t last = meshed(image, {}).tets.size();
  for (const double distance : {0.5, 1.0, 2.0}) {
    const std::size_t tets = meshed(image, {.decimation = {.distances = {distance, distance}}}).tets.size();
    EXPECT_LE(tets, last) << distance;
    last = tets;
  }
}

TEST(LatticeDecimation, SurfacesAreTheVoxelsOwnWhereADistanceIsZero) {
  LabelImage image = cbc3d::testing::noisy_blocks_image(2, 4);
  image.frame = cbc3d::testing::oblique(image.frame, false);
  for (const SurfaceDistanceBounds& distances : {SurfaceDistanceBounds{0, 0}, SurfaceDistanceBounds{2, 0}}) {
    const Mesh mesh = meshed(image, {.decimation = {.distances = distances}, .clean = false, .block = 16});
    const auto judged = metrics::evaluate_mesh(mesh, image, {.smooth = false, .certified = false});
    EXPECT_LE(judged.surface_hausdorff_mm.value_or(1), 1e-9);
    EXPECT_LE(judged.volume_error_percent_max.value_or(1), 1e-9);
    EXPECT_GE(judged.min_dihedral_deg.value_or(0), 15);
    EXPECT_EQ(judged.inverted, 0U);
    EXPECT_TRUE(judged.conforming);
  }
}

TEST(LatticeDecimation, CleansNoiseIntoManifoldsAndMeshesWhatIsLeft) {
  const LabelImage image = cbc3d::testing::noise_image(16, 0.5, 3);
  const auto judged = metrics::evaluate_mesh(meshed(image, {}), image, {.smooth = false, .certified = false});
  EXPECT_TRUE(judged.conforming);
  EXPECT_EQ(judged.inverted, 0U);
  EXPECT_GE(judged.min_dihedral_deg.value_or(0), 15);
  EXPECT_TRUE(judged.missing_labels.empty());
}

TEST(LatticeDecimation, RefusesAnEmptyImageAndABoundThatCannotBeMet) {
  const LabelImage empty = cbc3d::testing::make_image({4, 4, 4}, {1, 1, 1}, 1, [](const Vec3&) { return 0; });
  EXPECT_THROW(meshed(empty, {}), InputError);
  EXPECT_THROW(meshed(cbc3d::testing::touching_balls(), {.decimation = {.min_dihedral_deg = 46}}),
               InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::ld

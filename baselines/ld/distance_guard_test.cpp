// The distances of decimated meshes, measured by other code.
#include "baselines/ld/distance_guard.hpp"

#include "baselines/ld/lattice_decimation.hpp"
#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/testing/test_images.hpp"
#include "metrics/evaluate.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// The larger upper bound, of all labels, of a directed distance between the surfaces of mesh and voxels.
double certified_mm(const nlohmann::json& judged, const char* direction) {
  double largest = 0;
  for (const auto& label : judged["fidelity"]["per_label"]) {
    largest = std::fmax(largest, label["voxel_surface"][direction]["hausdorff_bounds_mm"][1].get<double>());
  }
  return largest;
}

class Distances : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Distances, AreWithinTheirBoundsBothWaysInAnAnisotropicImage) {
  LabelImage image = cbc3d::testing::touching_balls();
  image.frame.spacing_mm = {1, 1.2, 1.5};
  image.frame = cbc3d::testing::oblique(image.frame, true);
  const auto [image_to_mesh, mesh_to_image] = GetParam();
  StageClock clock;
  const Mesh mesh = mesh_by_lattice_decimation(
      image, {.decimation = {.distances = {image_to_mesh, mesh_to_image}}, .clean = false, .block = 16},
      clock);
  constexpr double kTolerance = 0.02;
  const nlohmann::json judged =
      metrics::evaluate(mesh, image, {.smooth = false, .tolerance_mm = kTolerance}, Progress());
  EXPECT_LE(certified_mm(judged, "image_to_mesh"), image_to_mesh + kTolerance);
  EXPECT_LE(certified_mm(judged, "mesh_to_image"), mesh_to_image + kTolerance);
  EXPECT_GT(certified_mm(judged, "mesh_to_image"), 0.1);  // it is not the exact mesh
  EXPECT_EQ(judged["topology"]["differences"], 0);
}

INSTANTIATE_TEST_SUITE_P(Bounds, Distances,
                         ::testing::Values(std::pair{0.9, 0.9}, std::pair{1.5, 0.6}, std::pair{0.6, 1.5},
                                           std::pair{2.5, 2.5}));

}  // namespace
}  // namespace cbc3d::baselines::ld

#include "mesher/pipeline/mesh_array.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/core/error.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

std::vector<std::uint8_t> values_of(const LabelImage& image) {
  std::vector<std::uint8_t> values(image.voxels.size());
  for (std::size_t v = 0; v < values.size(); ++v) {
    values[v] = static_cast<std::uint8_t>(image.labels[image.voxels[v]]);
  }
  return values;
}

bool same_mesh(const Mesh& a, const Mesh& b) {
  return a.points == b.points && a.tets.nodes == b.tets.nodes && a.tets.labels == b.tets.labels;
}

TEST(MeshArray, IsTheMeshOfTheImage) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  for (const std::string& preset : preset_names()) {
    const MeshImageOptions options = preset_options(preset, image.frame);
    MeshImageReport report;
    const Mesh expected = mesh_image(image, options, Progress(), report);
    const MeshedArray meshed = mesh_array(values_of(image), image.frame, options);
    EXPECT_TRUE(same_mesh(meshed.mesh, expected)) << preset;
    EXPECT_EQ(meshed.report.warnings, report.warnings);
  }
}

TEST(MeshArray, TheObserverSeesFractionsThatNeverFall) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  std::vector<double> fractions;
  mesh_array(values_of(image), image.frame, preset_options("paper", image.frame),
             [&](std::string_view, double fraction) {
               fractions.push_back(fraction);
               return true;
             });
  EXPECT_GE(fractions.size(), 8U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

TEST(MeshArray, CanBeCancelledAtAnyStepAndMeshesAgainAfterwards) {
  const LabelImage image = testing::ball_image(12, 1, 4);
  const std::vector<std::uint8_t> values = values_of(image);
  for (const std::string& preset : preset_names()) {
    const MeshImageOptions options = preset_options(preset, image.frame);
    int steps = 0;
    const Mesh whole = mesh_array(values, image.frame, options, [&](std::string_view, double) {
                         ++steps;
                         return true;
                       }).mesh;
    for (const int last : {0, 1, steps / 2, steps - 1}) {
      int step = 0;
      EXPECT_THROW(
          mesh_array(values, image.frame, options, [&](std::string_view, double) { return step++ < last; }),
          Cancelled);
      EXPECT_EQ(step, last + 1);
    }
    EXPECT_TRUE(same_mesh(mesh_array(values, image.frame, options).mesh, whole));
  }
}

TEST(MeshArray, RefusalsNameTheParameter) {
  const LabelImage image = testing::ball_image(20, 1, 7);
  MeshImageOptions options;
  options.lattice_spacing_mm = 1e-9;
  try {
    mesh_array(values_of(image), image.frame, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.parameter(), "lattice_spacing_mm");
    EXPECT_EQ(std::string(error.what()).find("--"), std::string::npos) << error.what();
  }
}

TEST(MeshArray, AnEmptyMeshIsAnError) {
  std::vector<std::int32_t> values(20 * 20 * 20, 0);
  values[4210] = 1;
  ImageFrame frame;
  frame.size = {20, 20, 20};
  MeshImageOptions options;
  options.lattice_spacing_mm = 20;
  options.refine.finest_spacing_mm = 20;
  EXPECT_THROW(mesh_array(values, frame, options), JobError);
}

}  // namespace
}  // namespace cbc3d

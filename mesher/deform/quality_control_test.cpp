// What the quality control holds back, and what it leaves.
#include <gtest/gtest.h>

#include <vector>

#include "mesher/deform/quality_control.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::paper_mesh;

TEST(QualityControl, HoldsBackWhatFailsAndNothingFar) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 4});
  const VertexCells around = cells_of_vertices(mesh);
  const QualityControl quality(mesh, around, {});
  std::vector<Vec3> displacement(mesh.points.size(), Vec3{0.1, 0, 0});
  displacement[100] = {30, 0, 0};  // through everything
  std::vector<Vec3> after = mesh.points;
  for (std::size_t v = 0; v < after.size(); ++v) {
    after[v] += displacement[v];
  }
  const auto failing = quality.failing(mesh.points, after);
  ASSERT_FALSE(failing.empty());
  const std::size_t held = quality.hold_back(mesh.points, failing, displacement, after);
  EXPECT_TRUE(quality.failing(mesh.points, after).empty());
  EXPECT_GE(held, 1U);
  EXPECT_LT(held, mesh.points.size() / 4);
  EXPECT_LT(displacement[100].norm(), 3);
  for (std::size_t v = 0; v < after.size(); ++v) {
    EXPECT_LT((after[v] - mesh.points[v] - displacement[v]).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace cbc3d

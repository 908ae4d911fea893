#include "metrics/mesh_raster.hpp"

#include <gtest/gtest.h>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

std::vector<RelabelledVoxels> raster(const Mesh& mesh, const LabelImage& image) {
  const MeshView view(mesh, image);
  return relabelled_voxels(view, image, {{0, 1}, {1, 2}});
}

TEST(MeshRaster, VoxelsAsTetsAreTheImage) {
  const LabelImage image = test::two_boxes();
  for (const RelabelledVoxels& found : raster(test::kuhn_mesh(image), image)) {
    EXPECT_TRUE(found.uncovered.empty());
    EXPECT_TRUE(found.overfilled.empty());
  }
}

TEST(MeshRaster, DifferencesAreFound) {
  const LabelImage image = test::two_boxes();
  LabelImage other = image;
  const std::size_t lost = other.frame.offset(3, 3, 3), changed = other.frame.offset(6, 4, 2),
                    added = other.frame.offset(1, 4, 4);
  other.voxels[lost] = 0;
  other.voxels[changed] = 1;
  other.voxels[added] = 1;
  const auto found = raster(test::kuhn_mesh(other), image);
  EXPECT_EQ(found[0].uncovered, std::vector<std::size_t>{lost});
  EXPECT_EQ(found[0].overfilled, (std::vector<std::size_t>{changed, added}));
  EXPECT_EQ(found[1].uncovered, std::vector<std::size_t>{changed});
  EXPECT_TRUE(found[1].overfilled.empty());
}

TEST(MeshRaster, TurnedAndMirroredFrame) {
  LabelImage image = test::two_boxes();
  image.frame.origin_mm = {10, -20, 5};
  image.frame.direction = Mat3::from_columns({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  ASSERT_TRUE(image.frame.left_handed());
  for (const RelabelledVoxels& found : raster(test::kuhn_mesh(image), image)) {
    EXPECT_TRUE(found.uncovered.empty());
    EXPECT_TRUE(found.overfilled.empty());
  }
}

}  // namespace
}  // namespace cbc3d::metrics

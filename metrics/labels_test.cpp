#include "metrics/labels.hpp"

#include <gtest/gtest.h>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

TEST(Labels, MissingAndUnknownOnesAreThoseOfOneSideAlone) {
  const LabelImage image = test::two_boxes();  // labels 1 and 7
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Label label : {1, 4, 0}) mesh.tets.add({0, 1, 2, 3}, label);
  const MeshView view(mesh, image);
  const LabelComparison labels = compare_labels(view, image, image.voxels_per_material());
  EXPECT_EQ(labels.missing, std::vector<Label>{7});
  EXPECT_EQ(labels.unknown, std::vector<Label>{4});  // 0 is background
}

TEST(Labels, OfNoVoxelAreNotMissing) {
  LabelImage image = test::two_boxes();
  image.labels.push_back(9);
  const Mesh mesh = test::kuhn_mesh(image);
  const MeshView view(mesh, image);
  const LabelComparison labels = compare_labels(view, image, image.voxels_per_material());
  EXPECT_TRUE(labels.missing.empty());
  EXPECT_TRUE(labels.unknown.empty());
}

}  // namespace
}  // namespace cbc3d::metrics

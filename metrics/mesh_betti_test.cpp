#include "metrics/mesh_betti.hpp"

#include <gtest/gtest.h>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

/// Of all cells of the voxels' mesh.
CellSetTopology topology_of(const LabelImage& image) {
  const Mesh mesh = test::kuhn_mesh(image);
  const MeshView view(mesh, image);
  return mesh_betti(view, sorted_facets(view)).all;
}

LabelImage box() {
  LabelImage image = test::empty_image({7, 7, 5}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {1, 1, 1}, {5, 5, 3}, 1);
  return image;
}

TEST(MeshBetti, ABoxIsOnePart) {
  const CellSetTopology found = topology_of(box());
  EXPECT_EQ(found.euler, 1);
  EXPECT_EQ(found.betti.value().b, (std::array<std::int64_t, 3>{1, 0, 0}));
}

TEST(MeshBetti, AHoleThroughTheBoxIsATunnel) {
  LabelImage image = box();
  test::fill_box(image, {3, 3, 1}, {3, 3, 3}, kBackground);
  EXPECT_EQ(topology_of(image).euler, 0);
  EXPECT_EQ(topology_of(image).betti.value().b, (std::array<std::int64_t, 3>{1, 1, 0}));
}

TEST(MeshBetti, AHoleInsideTheBoxIsACavity) {
  LabelImage image = box();
  test::fill_box(image, {3, 3, 2}, {3, 3, 2}, kBackground);
  EXPECT_EQ(topology_of(image).euler, 2);
  EXPECT_EQ(topology_of(image).betti.value().b, (std::array<std::int64_t, 3>{1, 0, 1}));
}

TEST(MeshBetti, LabelsAreSetsOfTheirOwn) {
  const LabelImage image = test::two_boxes();
  const Mesh mesh = test::kuhn_mesh(image);
  const MeshView view(mesh, image);
  const MeshBetti found = mesh_betti(view, sorted_facets(view));
  ASSERT_EQ(found.per_label.size(), 2U);
  EXPECT_EQ(found.per_label[0].euler, 1);
  EXPECT_EQ(found.per_label[1].euler, 1);
  EXPECT_EQ(found.all.euler, 1);  // they touch
}

TEST(MeshBetti, CellsThatDoNotFitTogetherHaveNone) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 0, -1}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  mesh.tets.add({0, 1, 2, 4}, 1);
  mesh.tets.add({0, 2, 1, 5}, 1);  // the third at one face
  const LabelImage image = test::empty_image({3, 3, 3}, {1, 1, 1}, {0, 1});
  const MeshView view(mesh, image);
  EXPECT_FALSE(mesh_betti(view, sorted_facets(view)).all.betti.has_value());
}

}  // namespace
}  // namespace cbc3d::metrics

// Meshes of materials: their files' labels, vertices and order.
#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/mixed_cubes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {
namespace {

TEST(MaterialMesh, ComesFromAFileWithTheImagesMaterials) {
  LabelImage image =
      testing::make_image({6, 6, 6}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 3 ? 1 : 2; });
  image.labels = {0, 40, 70};
  const MaterialMesh mesh = testing::mixed_cubes(4);
  for (const bool flipped : {false, true}) {
    image.frame = testing::oblique(ImageFrame{{6, 6, 6}}, flipped);
    const MaterialMesh back = to_material_mesh(to_physical_mesh(mesh, image), image);
    ASSERT_EQ(back.cell_count(), mesh.cell_count());
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      EXPECT_EQ(back.material_of(c), mesh.material_of(c));
      EXPECT_GT(testing::volume_of_cell(back, c), 0);
    }
  }
  Mesh stranger;
  stranger.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  stranger.tets.add({0, 1, 2, 3}, 9);
  EXPECT_THROW(to_material_mesh(stranger, image), InputError);
  Mesh wedge;
  wedge.points.resize(6);
  wedge.wedges.add({0, 1, 2, 3, 4, 5}, 1);
  EXPECT_THROW(to_material_mesh(wedge, image), InputError);
}

}  // namespace
}  // namespace cbc3d

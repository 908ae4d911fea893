#include "mesher/mesh_formats/surface_groups.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"

namespace cbc3d {
namespace {

TEST(SurfaceGroups, SplitMeshesHaveBothSides) {
  const Mesh mesh = testing::two_label_box(2);
  const FileMesh whole(mesh, {}), split(mesh, {.split = true});
  EXPECT_EQ(surface_groups(whole, {}).size(), 3U);
  const auto groups = surface_groups(split, {});
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].name, "label_3__label_7");
  EXPECT_EQ(groups[3].name, "label_7__label_3");
  EXPECT_EQ(groups[3].label, 7);
  EXPECT_EQ(facets_with(split, groups, 3), 48U + 16);
}

TEST(SurfaceGroups, TellsTrianglesFromQuadrilaterals) {
  const Mesh mesh = testing::one_of_each();
  const FileMesh view(mesh, {});
  const auto groups = surface_groups(view, {});
  EXPECT_GT(facets_with(view, groups, 3), 0U);
  EXPECT_GT(facets_with(view, groups, 4), 0U);
  EXPECT_EQ(corners_of_facet(6), 3U);
  EXPECT_EQ(corners_of_facet(4), 4U);
}

}  // namespace
}  // namespace cbc3d

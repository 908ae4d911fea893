#include "mesher/mesh_formats/labelled_interfaces.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"

namespace cbc3d {
namespace {

TEST(LabelledInterfaces, FindsEveryPairOfKindsThatMeet) {
  const Mesh mesh = testing::one_of_each();
  const FileMesh view(mesh, {.interfaces = false});
  EXPECT_TRUE(view.interfaces().empty());
  const auto found = labelled_interfaces(view.blocks(), mesh.points.size());
  std::size_t outer = 0, between = 0;
  for (const Interface& interface : found) {
    (interface.other ? between : outer) += interface.facets.size();
    EXPECT_EQ(interface.opposite.size(), interface.other ? interface.facets.size() : 0U);
  }
  EXPECT_EQ(outer + 2 * between, 4U + 5 + 5 + 6) << "every facet of every cell";
  EXPECT_GT(between, 0U);
}

TEST(LabelledInterfaces, RefusesAFacetOfThreeCells) {
  Mesh mesh = testing::two_label_box(1);
  mesh.tets.add(mesh.tets.nodes[0], 1);
  mesh.tets.add(mesh.tets.nodes[0], 1);
  const FileMesh view(mesh, {.interfaces = false});
  EXPECT_THROW(labelled_interfaces(view.blocks(), mesh.points.size()), InputError);
  EXPECT_THROW(FileMesh(mesh, {}), InputError);
}

}  // namespace
}  // namespace cbc3d

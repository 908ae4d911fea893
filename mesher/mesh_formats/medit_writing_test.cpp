#include "mesher/mesh_formats/medit_writing.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/gmsh_reading.hpp"
#include "mesher/mesh_formats/medit_reading.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

TEST(MeditWriting, IsReadBackWithNodesOrderAndLabels) {
  const testing::TemporaryFolder folder("medit");
  const Mesh mesh = testing::one_of_each();
  write_medit(FileMesh(mesh, {}), folder.file("m.mesh"), {});
  const Mesh back = read_medit(folder.file("m.mesh"));
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.tets.nodes, mesh.tets.nodes);
  EXPECT_EQ(back.pyramids.nodes, mesh.pyramids.nodes);
  EXPECT_EQ(back.wedges.nodes, mesh.wedges.nodes);
  EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes);
  EXPECT_EQ(labels_of(back), labels_of(mesh));
}

TEST(MeditWriting, MeshioReadsTheSameVolumes) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const testing::TemporaryFolder folder("medit");
  const Mesh mesh = testing::two_label_box(2);
  write_medit(FileMesh(mesh, {}), folder.file("m.mesh"), {});
  const nlohmann::json found = testing::reopened(folder.file("m.mesh"));
  testing::expect_volumes(found, mesh);
  EXPECT_EQ(found["cells"]["triangle"], 56);
}

TEST(MeditWriting, GmshReadsTheSameCells) {
  if (!testing::has_program("gmsh")) GTEST_SKIP() << "gmsh is not installed";
  const testing::TemporaryFolder folder("medit");
  const Mesh mesh = testing::two_label_box(2);
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  const FileMesh linear_view(mesh, {}), quadratic_view(quadratic, {});
  for (const FileMesh* view : {&linear_view, &quadratic_view}) {
    write_medit(*view, folder.file("m.mesh"), {});
    const auto outcome =
        testing::run_program("gmsh '" + folder.file("m.mesh").string() +
                             "' -save -save_all -format msh22 -o '" + folder.file("m.msh").string() + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("Error"), std::string::npos) << outcome.text;
    if (view == &linear_view) {
      const Mesh back = read_gmsh(folder.file("m.msh"), {.label_array = "gmsh:geometrical"});
      EXPECT_EQ(testing::tet_volumes(back), testing::tet_volumes(mesh)) << outcome.text;
    } else if (testing::has_meshio()) {
      const nlohmann::json found = testing::reopened(folder.file("m.msh"));
      EXPECT_EQ(found["cells"]["tetra10"], 48);
      EXPECT_LT(found["bent"].get<double>(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace cbc3d

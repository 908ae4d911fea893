// VTK's formats, as meshio finds them.
#include "mesher/mesh_formats/vtk_writing.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/mesh_formats/vtk_reading.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

TEST(VtkWriting, MeshioReadsTheSameVolumes) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const testing::TemporaryFolder folder("vtk");
  const Mesh mesh = testing::two_label_box(2);
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  const FileMesh linear_view(mesh, {.interfaces = false}), quadratic_view(quadratic, {.interfaces = false});
  for (const auto& [name, write] : {std::pair{"m.vtu", &write_vtu}, std::pair{"b.vtk", &write_vtk},
                                    std::pair{"a.vtk", &write_vtk_text}}) {
    write(linear_view, folder.file(name), {});
    testing::expect_volumes(testing::reopened(folder.file(name)), mesh);
    write(quadratic_view, folder.file(name), {});
    const nlohmann::json found = testing::reopened(folder.file(name));
    testing::expect_volumes(found, mesh);
    EXPECT_EQ(found["cells"]["tetra10"], 48) << name;
    EXPECT_EQ(found["points"], 125) << name;
  }
}

TEST(VtkWriting, TextIsTextAndReadBack) {
  const testing::TemporaryFolder folder("vtk");
  const Mesh mesh = testing::two_label_box(2);
  write_vtk_text(FileMesh(mesh, {.interfaces = false}), folder.file("m.vtk"), {});
  EXPECT_NE(folder.content("m.vtk").find("\nASCII\n"), std::string::npos);
  MeshFileOptions stated;
  EXPECT_EQ(read_vtk(folder.file("m.vtk"), VtkFormat::legacy, "", stated).tets.nodes, mesh.tets.nodes);
}

}  // namespace
}  // namespace cbc3d

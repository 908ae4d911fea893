// Meshes: what is written is read back, what is bad is refused and leaves nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_files.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {
namespace {

using testing::one_of_each;

class MeshIo : public testing::Files {};

TEST_F(MeshIo, MeshesKeepNodesOrderAndLabels) {
  const Mesh mesh = one_of_each();
  for (const char* name : {"m.vtu", "m.vtk", "m.msh", "m.inp", "m.mesh"}) {
    write_mesh(mesh, file(name));
    const Mesh back = read_mesh(file(name));
    ASSERT_EQ(back.points.size(), mesh.points.size()) << name;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      EXPECT_NEAR((back.points[v] - mesh.points[v]).norm(), 0, std::string(name) == "m.inp" ? 1e-11 : 0)
          << name;
    }
    EXPECT_EQ(back.tets.nodes, mesh.tets.nodes) << name;
    EXPECT_EQ(back.pyramids.nodes, mesh.pyramids.nodes) << name;
    EXPECT_EQ(back.wedges.nodes, mesh.wedges.nodes) << name;
    EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes) << name;
    EXPECT_EQ(labels_of(back), (std::vector<Label>{3, 4, 5, 6})) << name;
  }
}

TEST_F(MeshIo, LegacyVtkIsWrittenAsVersion42) {
  write_mesh(one_of_each(), file("m.vtk"));
  std::string first;
  std::ifstream in(file("m.vtk"));
  std::getline(in, first);
  EXPECT_NE(first.find("4.2"), std::string::npos) << first;
}

TEST_F(MeshIo, BadMeshPathsAreRefusedAndLeaveNothing) {
  EXPECT_THROW(write_mesh(one_of_each(), file("m.stl")), InputError);
  EXPECT_THROW(write_mesh(one_of_each(), folder_.path() / "no" / "m.vtu"), InputError);
  EXPECT_THROW(read_mesh(file("absent.vtu")), InputError);
  write("broken.vtu", "<VTKFile");
  EXPECT_THROW(read_mesh(file("broken.vtu")), InputError);
  write("broken.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  EXPECT_THROW(read_mesh(file("broken.msh")), InputError);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 2U);  // the two broken ones
}

}  // namespace
}  // namespace cbc3d

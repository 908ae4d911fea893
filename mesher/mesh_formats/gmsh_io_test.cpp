// Gmsh's text format: what is written, what other tools write, what is refused.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/gmsh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

const std::string kFormat = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kNodes = "$Nodes\n4\n10 0 0 0\n7 1 0 0\n300 0 1 0\n8 0 0 1\n$EndNodes\n";

TEST(GmshIo, WritesNamedGroupsAndReadsThemBack) {
  const testing::TemporaryFolder folder("gmsh");
  const Mesh mesh = testing::one_of_each();
  write_gmsh(mesh, folder.file("m.msh"));
  const std::string text = folder.content("m.msh");
  EXPECT_EQ(text.rfind(kFormat, 0), 0U);
  for (const char* name : {"3 3 \"label_3\"", "3 4 \"label_4\"", "3 5 \"label_5\"", "3 6 \"label_6\""}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
  const Mesh back = read_gmsh(folder.file("m.msh"));
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes);
  EXPECT_EQ(labels_of(back), labels_of(mesh));
}

TEST(GmshIo, NodeNumbersAreArbitraryAndLowerCellsPassedOver) {
  const testing::TemporaryFolder folder("gmsh");
  folder.write("m.msh",
               kFormat + kNodes +
                   "$Elements\n3\n1 15 2 1 1 10\n2 2 2 1 1 10 7 300\n3 4 2 42 1 10 7 300 8\n$EndElements\n");
  const Mesh mesh = read_gmsh(folder.file("m.msh"));
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.tets.nodes[0], (std::array<VertexId, 4>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.tets.labels[0], 42);
  EXPECT_EQ(mesh.points[2], (Vec3{0, 1, 0}));
}

TEST(GmshIo, RefusesWhatItCannotKeepOrRead) {
  const testing::TemporaryFolder folder("gmsh");
  Mesh mesh = testing::one_of_each();
  mesh.tets.labels[0] = 0;
  EXPECT_THROW(write_gmsh(mesh, folder.file("zero.msh")), InputError);
  const std::vector<std::string> broken = {
      "",
      "no format",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
      kFormat + kNodes,
      kFormat + "$Nodes\n4\n1 0 0 0\n",                                          // ends within the nodes
      kFormat + kNodes + "$Elements\n1\n1 4 2 1 1 10 7 300 9\n$EndElements\n",   // a node that is not there
      kFormat + kNodes + "$Elements\n1\n1 11 2 1 1 10 7 300 8\n$EndElements\n",  // a quadratic tet
      kFormat + kNodes + "$Elements\n2\n1 4 2 1 1 10 7 300 8\n"};                // ends within the elements
  for (const std::string& text : broken) {
    folder.write("broken.msh", text);
    try {
      read_gmsh(folder.file("broken.msh"));
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("broken.msh"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cbc3d

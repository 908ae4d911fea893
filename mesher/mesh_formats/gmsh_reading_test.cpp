// Gmsh's formats as other tools write them; what is refused.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/gmsh_reading.hpp"
#include "mesher/mesh_formats/gmsh_writing.hpp"
#include "mesher/mesh_formats/testing_damage.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

const std::string kFormat = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kNodes = "$Nodes\n4\n10 0 0 0\n7 1 0 0\n300 0 1 0\n8 0 0 1\n$EndNodes\n";

TEST(GmshReading, NodeNumbersAreArbitraryAndLowerCellsPassedOver) {
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

TEST(GmshReading, RefusesWhatItCannotRead) {
  const testing::TemporaryFolder folder("gmsh");
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

TEST(GmshReading, ReadsVersion41AndTheGeometryWhereItIsAsked) {
  const testing::TemporaryFolder folder("gmsh");
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nx\n$EndComments\n"
      "$Entities\n1 0 0 2\n1 0 0 0 0\n1 0 0 0 1 1 1 1 42 0\n2 0 0 0 1 1 1 0 0\n$EndEntities\n"
      "$Nodes\n2 5 1 300\n0 1 1 1\n10\n0 0 0\n3 1 0 4\n7\n300\n8\n9\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
      "$Elements\n3 3 1 3\n0 1 15 1\n1 10\n3 1 4 1\n2 10 7 300 8\n3 2 4 1\n3 7 300 8 9\n$EndElements\n";
  folder.write("m.msh", text);
  const Mesh mesh = read_gmsh(folder.file("m.msh"));
  ASSERT_EQ(mesh.tets.size(), 2U);
  EXPECT_EQ(mesh.tets.nodes[1], (std::array<VertexId, 4>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.tets.labels, (std::vector<Label>{42, 0}));
  EXPECT_EQ(read_gmsh(folder.file("m.msh"), {.label_array = "gmsh:geometrical"}).tets.labels,
            (std::vector<Label>{1, 2}));
  EXPECT_THROW(read_gmsh(folder.file("m.msh"), {.label_array = "label"}), InputError);
  EXPECT_EQ(testing::damage_taken(text, folder.file("cut.msh"), read_gmsh), "") << "only at its very end";
}

TEST(GmshReading, NoBinaryDamageIsTaken) {
  if (!testing::has_program("gmsh")) GTEST_SKIP() << "gmsh is not installed";
  const testing::TemporaryFolder folder("gmsh");
  write_gmsh41(FileMesh(testing::two_label_box(1), {}), folder.file("m.msh"), {});
  for (const std::string format : {"msh22", "msh41"}) {
    const std::string binary = folder.file("binary.msh").string();
    const auto outcome = testing::run_program("gmsh '" + folder.file("m.msh").string() +
                                              "' -save -bin -format " + format + " -o '" + binary + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(read_gmsh(binary).tets.size(), 6U);
    EXPECT_EQ(testing::damage_taken(folder.content("binary.msh"), folder.file("cut.msh"), read_gmsh), "")
        << format;
  }
}

}  // namespace
}  // namespace cbc3d

#include "mesher/mesh_formats/medit_reading.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/testing_damage.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

const std::string kMesh =
    "MeshVersionFormatted 1\n# by hand\nDimension\n3\nVertices\n5\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1. 1\n1 1 "
    "1 # up\n 1\n"
    "Triangles\n1\n1 2 3 9\nRequiredVertices 1 2\nTetrahedra\n2\n1 2 3 4 -5\n2 3 4 5 8\nEnd\n";

TEST(MeditReading, ReferencesAreLabels) {
  const testing::TemporaryFolder folder("medit");
  folder.write("m.mesh", kMesh);
  const Mesh mesh = read_medit(folder.file("m.mesh"));
  ASSERT_EQ(mesh.tets.size(), 2U);
  EXPECT_EQ(mesh.tets.nodes[1], (std::array<VertexId, 4>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.tets.labels, (std::vector<Label>{-5, 8}));
  EXPECT_EQ(mesh.points[4], (Vec3{1, 1, 1}));
  EXPECT_THROW(read_medit(folder.file("m.mesh"), {.label_array = "label"}), InputError);
}

TEST(MeditReading, NoDamageIsTaken) {
  const testing::TemporaryFolder folder("medit");
  EXPECT_EQ(testing::damage_taken(kMesh, folder.file("cut.mesh"), read_medit), "");
}

TEST(MeditReading, RefusesWhatItDoesNotKnow) {
  const testing::TemporaryFolder folder("medit");
  const std::string begin = "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\n";
  for (const std::string& text :
       {std::string("Dimension 3\nEnd\n"), begin + "End\n", begin + "TetrahedraP2\n0\nEnd\n",
        begin + "Tetrahedra\n1\n1 1 1 2 0\nEnd\n", begin + "Tetrahedra\n1\n1 1 1 1 99999999999\nEnd\n",
        begin + "5 Tetrahedra\n0\nEnd\n", std::string("MeshVersionFormatted 2\nDimension 2\nEnd\n")}) {
    folder.write("m.mesh", text);
    EXPECT_THROW(read_medit(folder.file("m.mesh")), InputError) << text;
  }
}

}  // namespace
}  // namespace cbc3d

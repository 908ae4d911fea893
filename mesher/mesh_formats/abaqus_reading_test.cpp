#include "mesher/mesh_formats/abaqus_reading.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/testing_damage.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

const std::string kNodes = "*Heading\n a mesh\n*Node\n1, 0,0,0\n2, 1.,0,0\n3,0,1,0\n4,0,0,1.0D0\n5,1,1,1\n";
const std::string kTwo = "*Element, type=C3D4\n1, 1,2,3,4\n2, 2,3,\n4,5\n";

class AbaqusReading : public ::testing::Test {
 protected:
  std::vector<Label> labels_in(const std::string& text) {
    folder_.write("m.inp", text);
    return read_abaqus(folder_.file("m.inp")).tets.labels;
  }
  testing::TemporaryFolder folder_{"abaqus"};
};

TEST_F(AbaqusReading, SetsOfElementsAreLabels) {
  using Labels = std::vector<Label>;
  EXPECT_EQ(labels_in(kNodes + "*Element, type=S3, ELSET=Skin\n9, 1,2,3\n" + kTwo), (Labels{1, 1}))
      << "no set";
  const std::string first = "*ELEMENT, TYPE=C3D4, ELSET=",
                    second = "\n1, 1,2,3,4\n*ELEMENT, TYPE=C3D4H, ELSET=", end = "\n2, 2,3,4,5\n";
  EXPECT_EQ(labels_in(kNodes + first + "Liver" + second + "Vessel" + end), (Labels{1, 2})) << "in turn";
  EXPECT_EQ(labels_in(kNodes + first + "label_9" + second + "label_m4" + end), (Labels{9, -4}))
      << "by their names";
  EXPECT_EQ(labels_in("** LABEL 30 = liver\n** LABEL -2 = Vessel\n" + kNodes + first + "Liver" + second +
                      "Vessel" + end),
            (Labels{30, -2}))
      << "by our comments";
  EXPECT_EQ(labels_in(kNodes + kTwo + "*Elset, elset=A7, generate\n1, 1\n*Elset, elset=B2\n2,\n"),
            (Labels{7, 2}));
}

TEST_F(AbaqusReading, ReadsElementsThatGoOnInTheNextLine) {
  folder_.write("m.inp", kNodes + kTwo);
  const Mesh mesh = read_abaqus(folder_.file("m.inp"));
  EXPECT_EQ(mesh.tets.nodes[1], (std::array<VertexId, 4>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.points[3], (Vec3{0, 0, 1}));
  EXPECT_THROW(read_abaqus(folder_.file("m.inp"), {.label_array = "x"}), InputError);
}

TEST_F(AbaqusReading, RefusesWhatIsNoMeshWithLabels) {
  for (const std::string& text :
       {std::string(), kNodes, kNodes + "*ELEMENT, TYPE=C3D10\n", kNodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3,6\n",
        kNodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3\n", kNodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4,5\n",
        kNodes + "1, 0, 0, 0\n" + kTwo, kNodes + "*INCLUDE, INPUT=x\n" + kTwo,
        kNodes + kTwo + "*ELSET, ELSET=A\n1\n", kNodes + kTwo + "*ELSET, ELSET=A\n1,2\n*ELSET, ELSET=B\n2\n",
        kNodes + kTwo + "*ELSET, ELSET=A, GENERATE\n1, 99999999999999\n",
        kNodes + kTwo + "*ELSET, ELSET=A, GENERATE\n1, 2, 0\n", kNodes + "6, 0, nan, 0\n" + kTwo}) {
    EXPECT_THROW(labels_in(text), InputError) << text;
  }
}

/// What our writer states.
TEST_F(AbaqusReading, FewerNodesOrElementsThanStatedAreRefused) {
  const auto with = [&](const std::string& counts) { return "** NODES " + counts + "\n" + kNodes + kTwo; };
  EXPECT_EQ(labels_in(with("5, ELEMENTS 2")).size(), 2U);
  EXPECT_EQ(labels_in(with("4, ELEMENTS 1")).size(), 2U) << "more were added";
  EXPECT_THROW(labels_in(with("6, ELEMENTS 2")), InputError);
  EXPECT_THROW(labels_in(with("5, ELEMENTS 3")), InputError);
  EXPECT_THROW(labels_in(with("5, ELEMENTS x")), InputError);
}

/// The format has no end and no counts, so that a cut between two elements of a mesh is not seen; every other
/// is.
TEST_F(AbaqusReading, DamageEndsInAMeshOrALine) {
  const std::string text = kNodes + kTwo;
  for (std::size_t length = 0; length < text.size(); ++length) {
    try {
      EXPECT_GE(labels_in(text.substr(0, length)).size(), 1U);
      EXPECT_GE(length, kNodes.size() + 30);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cbc3d

// XDMF: meshio reads the same points, volumes, labels and edge nodes.
#include "mesher/mesh_formats/xdmf_writing.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class XdmfWriting : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file() const { return folder_.file("m.xdmf").string(); }
  testing::TemporaryFolder folder_{"xdmf"};
};

TEST_F(XdmfWriting, StatesNamesAndCoordinates) {
  MeshFileOptions options;
  options.coordinates = "RAS";
  options.names.set({.label = 3, .name = "a < \"b\" --> c", .colour = {{200, 80, 8}}});
  write_xdmf(FileMesh(testing::one_of_each(), {}), file(), options);
  const std::string text = folder_.content("m.xdmf");
  EXPECT_NE(text.find("<!-- coordinates RAS, mm -->"), std::string::npos) << text;
  EXPECT_NE(text.find("<!-- name 3 = a < \"b\" - -> c -->"), std::string::npos) << text;
  EXPECT_NE(text.find("<!-- colour 3 = #c85008 -->"), std::string::npos) << text;
}

TEST_F(XdmfWriting, MeshioReadsTheSameTets) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const Mesh mesh = testing::two_label_box(2);
  MeshFileOptions options;
  options.names.set({.label = 3, .name = "<heart> & --aorta", .colour = {{200, 80, 8}}});
  write_xdmf(FileMesh(mesh, {}), file(), options);
  const nlohmann::json found = testing::reopened(file());
  EXPECT_EQ(found["points"], mesh.points.size());
  testing::expect_volumes(found, mesh);
}

TEST_F(XdmfWriting, MeshioReadsTheSameQuadraticTets) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const Mesh mesh = testing::two_label_box(2);
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  write_xdmf(FileMesh(quadratic, {}), file(), {});
  const nlohmann::json found = testing::reopened(file());
  EXPECT_EQ(found["cells"]["tetra10"], 48);
  EXPECT_LT(found["bent"].get<double>(), 1e-12);
  testing::expect_volumes(found, mesh);
}

TEST_F(XdmfWriting, MeshioReadsCellsOfEveryKind) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  write_xdmf(FileMesh(testing::one_of_each(), {}), file(), {});
  const nlohmann::json found = testing::reopened(file());
  for (const char* const kind : {"tetra", "pyramid", "wedge", "hexahedron"})
    EXPECT_EQ(found["cells"][kind], 1) << kind;
  EXPECT_NEAR(found["volumes"]["3"].get<double>(), testing::tet_volumes(testing::one_of_each())[3], 1e-12);
}

}  // namespace
}  // namespace cbc3d

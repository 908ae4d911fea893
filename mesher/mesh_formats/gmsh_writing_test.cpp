// Gmsh's formats: groups of volumes and interfaces with their names, as Gmsh, meshio and our reader find
// them.
#include "mesher/mesh_formats/gmsh_writing.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/gmsh_reading.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class GmshWriting : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name).string(); }
  static MeshFileOptions named() {
    MeshFileOptions options;
    options.names.set({.label = 7, .name = "right lung", .colour = {}});
    return options;
  }
  /// Gmsh opens m.msh without a word of warning and saves it as again.msh.
  void expect_saved(const std::string& format) const {
    const auto outcome = testing::run_program("gmsh '" + file("m.msh") + "' -save -format " + format +
                                              " -o '" + file("again.msh") + "'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("Error"), std::string::npos) << outcome.text;
    EXPECT_EQ(outcome.text.find("Warning"), std::string::npos) << outcome.text;
  }
  testing::TemporaryFolder folder_{"gmsh"};
};

TEST_F(GmshWriting, NamesVolumesAndInterfaces) {
  const Mesh mesh = testing::two_label_box(2);
  for (const auto write : {write_gmsh22, write_gmsh41}) {
    write(FileMesh(mesh, {}), file("m.msh"), named());
    const std::string text = folder_.content("m.msh");
    for (const char* name :
         {"2 1 \"label_3__right_lung\"", "2 2 \"label_3__exterior\"", "2 3 \"right_lung__exterior\"",
          "3 3 \"label_3\"", "3 7 \"right_lung\"", "coordinates LPS, mm"}) {
      EXPECT_NE(text.find(name), std::string::npos) << name << '\n' << text.substr(0, 500);
    }
    const Mesh back = read_gmsh(file("m.msh"));
    EXPECT_EQ(testing::tet_volumes(back), testing::tet_volumes(mesh));
  }
}

TEST_F(GmshWriting, KeepsTheOrderOfNodesInVersion22) {
  const Mesh mesh = testing::one_of_each();
  write_gmsh22(FileMesh(mesh, {}), file("m.msh"), {});
  EXPECT_EQ(folder_.content("m.msh").rfind("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", 0), 0U);
  const Mesh back = read_gmsh(file("m.msh"));
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes);
  EXPECT_EQ(labels_of(back), labels_of(mesh));
}

TEST_F(GmshWriting, MixedElementsKeepTheirNodesInVersion41) {
  const Mesh mesh = testing::one_of_each();
  write_gmsh41(FileMesh(mesh, {}), file("m.msh"), {});
  const Mesh back = read_gmsh(file("m.msh"));
  ASSERT_EQ(back.cell_count(), 4U);
  for (std::size_t n = 0; n < 8; ++n) {
    EXPECT_EQ(back.points[back.hexes.nodes[0][n]], mesh.points[mesh.hexes.nodes[0][n]]);
  }
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_EQ(back.points[back.wedges.nodes[0][n]], mesh.points[mesh.wedges.nodes[0][n]]);
  }
}

TEST_F(GmshWriting, RefusesLabelsThatAreNotPositive) {
  Mesh mesh = testing::one_of_each();
  mesh.tets.labels[0] = 0;
  EXPECT_THROW(write_gmsh22(FileMesh(mesh, {}), file("m.msh"), {}), InputError);
  EXPECT_THROW(write_gmsh41(FileMesh(mesh, {}), file("m.msh"), {}), InputError);
  EXPECT_THROW(require_gmsh_labels({-1, 3}), InputError);
}

TEST_F(GmshWriting, MeshioReadsTheSameVolumes) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const Mesh mesh = testing::two_label_box(2);
  for (const auto write : {write_gmsh22, write_gmsh41}) {
    write(FileMesh(mesh, {}), file("m.msh"), named());
    const nlohmann::json found = testing::reopened(file("m.msh"));
    testing::expect_volumes(found, mesh);
    EXPECT_EQ(found["cells"]["tetra"], 48);
    EXPECT_EQ(found["cells"]["triangle"], 56) << "48 outside, 8 between";
    EXPECT_EQ(found["names"]["right_lung"], (nlohmann::json{7, 3}));
  }
}

/// Gmsh opens each version and saves it in the other, as text and binary; split meshes too.
TEST_F(GmshWriting, GmshReadsAndWritesItAgain) {
  if (!testing::has_program("gmsh")) GTEST_SKIP() << "gmsh is not installed";
  const Mesh mesh = testing::two_label_box(2);
  const FileMesh shared(mesh, {}), split(mesh, {.split = true});
  for (const FileMesh* view : {&shared, &split}) {
    for (const auto write : {write_gmsh22, write_gmsh41}) {
      write(*view, file("m.msh"), named());
      for (const char* other : {"msh22", "msh41 -bin", "msh22 -bin"}) {
        expect_saved(other);
        const Mesh back = read_gmsh(file("again.msh"));
        EXPECT_EQ(testing::tet_volumes(back), testing::tet_volumes(mesh)) << other;
        EXPECT_EQ(back.points.size(), view == &split ? 36U : 27U);
      }
    }
  }
}

TEST_F(GmshWriting, GmshAndMeshioReadQuadraticTets) {
  if (!testing::has_program("gmsh") || !testing::has_meshio())
    GTEST_SKIP() << "gmsh or python3-meshio is not installed";
  const Mesh mesh = testing::two_label_box(2);
  const QuadraticMesh quadratic = straight_quadratic_mesh(mesh);
  for (const auto write : {write_gmsh22, write_gmsh41}) {
    write(FileMesh(quadratic, {}), file("m.msh"), named());
    expect_saved("msh22");
    for (const char* name : {"m.msh", "again.msh"}) {
      const nlohmann::json found = testing::reopened(file(name));
      testing::expect_volumes(found, mesh);
      EXPECT_EQ(found["cells"]["tetra10"], 48);
      EXPECT_EQ(found["cells"]["triangle6"], 56);
      EXPECT_LT(found["bent"].get<double>(), 1e-12) << "edge nodes are in Gmsh's order";
    }
  }
}

}  // namespace
}  // namespace cbc3d

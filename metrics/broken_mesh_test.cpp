// Broken meshes are named.
#include <gtest/gtest.h>

#include <limits>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

namespace fs = std::filesystem;

class BrokenMesh : public ::testing::Test {
 protected:
  // The message of the error that reading the file and judging its mesh ends with; "" without one.
  [[nodiscard]] std::string error_of(const std::string& name) const {
    try {
      test::judge(read_mesh(folder_.file(name)), test::two_boxes(), {false, false});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }

  cbc3d::testing::TemporaryFolder folder_{"broken"};
};

// Legacy VTK text with one tet.
std::string vtk_text(const std::string& fourth_point, int type, const std::string& data) {
  return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 "
         "0 " +
         fourth_point + "\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n" + std::to_string(type) + "\n" + data;
}
const char* const kLabel = "CELL_DATA 1\nSCALARS label int 1\nLOOKUP_TABLE default\n1\n";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool any_contains(const nlohmann::json& faults, const std::string& part) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const nlohmann::json& fault) { return contains(fault.get<std::string>(), part); });
}

TEST_F(BrokenMesh, SoundFileIsRead) {
  write("sound.vtk", vtk_text("0 0 1", 10, kLabel));
  EXPECT_EQ(error_of("sound.vtk"), "");
}

TEST_F(BrokenMesh, UnknownCellType) {
  write("type.vtk", vtk_text("0 0 1", 24, kLabel));  // a quadratic tet
  EXPECT_TRUE(contains(error_of("type.vtk"), "cells of VTK type 24")) << error_of("type.vtk");
  write("quadratic.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
        "$Elements\n1\n1 11 2 1 1 1 2 3 4 1 2 3 4 1 2\n$EndElements\n");
  EXPECT_TRUE(contains(error_of("quadratic.msh"), "11"));
}

TEST_F(BrokenMesh, NoLabelArray) {
  write("plain.vtk", vtk_text("0 0 1", 10, ""));
  EXPECT_TRUE(contains(error_of("plain.vtk"), "'label'"));
}

TEST_F(BrokenMesh, CoordinateIsNoNumber) {
  Mesh mesh = test::kuhn_mesh(test::two_boxes());
  mesh.points[3].y = std::numeric_limits<double>::quiet_NaN();
  write_mesh(mesh, folder_.path() / "nan.vtu");
  EXPECT_TRUE(contains(error_of("nan.vtu"), "point 3 has a coordinate that is no finite number"))
      << error_of("nan.vtu");
  write("nan.vtk", vtk_text("0 nan 1", 10, kLabel));  // VTK reads no such text
  EXPECT_TRUE(contains(error_of("nan.vtk"), "nan.vtk")) << error_of("nan.vtk");
}

TEST_F(BrokenMesh, NoCells) {
  write("empty.vtk",
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 0 double\nCELLS 0 "
        "0\nCELL_TYPES 0\n");
  EXPECT_TRUE(contains(error_of("empty.vtk"), "with cells"));
  const auto result = test::judge(Mesh{}, test::two_boxes());
  EXPECT_TRUE(any_contains(result["faults"], "the mesh has no cells"));
  EXPECT_TRUE(any_contains(result["faults"], "label 1 of the image is in no cell"));
}

TEST_F(BrokenMesh, TruncatedFiles) {
  for (const std::string name : {"cut.vtu", "cut.vtk", "cut.msh"}) {
    write_mesh(test::kuhn_mesh(test::two_boxes()), folder_.path() / name);
    EXPECT_EQ(error_of(name), "") << name;
    for (const double share : {.9, .5, .02}) {
      fs::resize_file(folder_.path() / name,
                      static_cast<std::uintmax_t>(share * double(fs::file_size(folder_.path() / name))));
      EXPECT_TRUE(contains(error_of(name), name)) << name << " at " << share << ": " << error_of(name);
    }
  }
}

TEST_F(BrokenMesh, VertexThatIsNotThere) {
  write("vertex.vtk",
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 "
        "0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 7\nCELL_TYPES 1\n10\n" +
            std::string(kLabel));
  EXPECT_TRUE(contains(error_of("vertex.vtk"), "has node 7, but there are 4 points"));
}

LabelImage block_image() {
  LabelImage image = test::empty_image({7, 7, 7}, {1, 1, 1}, {0, 1, 7});
  test::fill_box(image, {1, 1, 1}, {5, 5, 5}, 1);
  return image;
}

nlohmann::json faults_of(const Mesh& mesh) {
  return test::judge(mesh, block_image(), {false, false})["faults"];
}

TEST_F(BrokenMesh, Hole) {
  LabelImage drilled = block_image();
  drilled.voxels[drilled.frame.offset(3, 3, 3)] = 0;
  const auto faults = faults_of(test::kuhn_mesh(drilled));
  EXPECT_TRUE(any_contains(faults,
                           "label 1: 1 parts, 0 tunnels, 1 cavities in the mesh, 1 parts, 0 tunnels, 0 "
                           "cavities in the image"))
      << faults;
}

TEST_F(BrokenMesh, InvertedElement) {
  Mesh mesh = test::kuhn_mesh(block_image());
  std::swap(mesh.tets.nodes[17][0], mesh.tets.nodes[17][1]);
  const auto faults = faults_of(mesh);
  EXPECT_TRUE(any_contains(faults, "1 inverted or flat cells (0 of them flat), first tet (cell 17) at ("))
      << faults;
  EXPECT_TRUE(any_contains(faults, "facets whose two cells lie on the same side")) << faults;
}

TEST_F(BrokenMesh, DuplicatedVertex) {
  Mesh mesh = test::kuhn_mesh(block_image());
  const VertexId old = mesh.tets.nodes[100][2];
  mesh.points.push_back(mesh.points[old]);
  mesh.tets.nodes[100][2] = static_cast<VertexId>(mesh.points.size() - 1);
  EXPECT_TRUE(any_contains(faults_of(mesh), "1 vertices where another vertex is, first vertex 512"))
      << faults_of(mesh);
}

TEST_F(BrokenMesh, TJunction) {
  Mesh mesh;
  mesh.points = {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 2}, {1, 1, 0}, {2, 2, 1}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  mesh.tets.add({1, 0, 5, 4}, 1);
  mesh.tets.add({5, 0, 2, 4}, 1);
  const auto faults = faults_of(mesh);
  EXPECT_TRUE(any_contains(faults,
                           "1 vertices that hang in a facet or an edge of another cell (T-junctions), first "
                           "vertex 5 at (2, 2, 1) mm"))
      << faults;
}

TEST_F(BrokenMesh, LabelThatTheImageHasNot) {
  Mesh mesh = test::kuhn_mesh(block_image());
  mesh.tets.labels[3] = 40;
  EXPECT_TRUE(any_contains(faults_of(mesh), "label 40 of the mesh is not in the image"));
}

TEST_F(BrokenMesh, FoldedHex) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {.2, .2, .2}, {0, 1, 1}};
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  EXPECT_TRUE(any_contains(faults_of(mesh), "1 cells of positive volume are folded at a corner"))
      << faults_of(mesh);
}

}  // namespace
}  // namespace cbc3d::metrics

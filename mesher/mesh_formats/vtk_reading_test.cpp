// Damaged VTK files are refused in one line, whatever VTK's readers do with them.
#include "mesher/mesh_formats/vtk_reading.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class VtkReading : public ::testing::Test {
 protected:
  /// The refusal of these bytes; empty when they are taken.
  [[nodiscard]] std::string refusal_of(const std::string& bytes, VtkFormat format) const {
    folder_.write("m", bytes);
    try {
      MeshFileOptions stated;
      read_vtk(folder_.file("m"), format, "", stated);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }
  testing::TemporaryFolder folder_{"vtk"};
};

/// One tet, in text.
std::string vtu(const std::string& cells, const std::string& label = "1",
                const std::string& points = "0 0 0 1 0 0 0 1 0 0 0 1") {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
         "NumberOfComponents=\"3\" "
         "format=\"ascii\">" +
         points + "</DataArray></Points>" + cells +
         "<CellData><DataArray type=\"Float64\" Name=\"label\" format=\"ascii\">" + label +
         "</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>";
}

std::string cells(const std::string& ids, const std::string& offset, const std::string& type) {
  return "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" + ids +
         "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offset +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + type +
         "</DataArray></Cells>";
}

TEST_F(VtkReading, GoodFilesAreRead) {
  EXPECT_EQ(refusal_of(vtu(cells("0 1 2 3", "4", "10")), VtkFormat::xml), "");
  for (const char* name : {"g.vtu", "g.vtk"}) {
    write_mesh(testing::one_of_each(), folder_.file(name));
    const Mesh back = read_mesh(folder_.file(name));
    EXPECT_EQ(back.cell_count(), 4U) << name;
    EXPECT_EQ(back.wedges.nodes[0], testing::one_of_each().wedges.nodes[0]) << name;
  }
}

TEST_F(VtkReading, TheLabelArrayMayHaveAnyName) {
  const std::string file = vtu(cells("0 1 2 3", "4", "10"), "9");
  folder_.write("m", file);
  MeshFileOptions stated;
  EXPECT_EQ(read_vtk(folder_.file("m"), VtkFormat::xml, "label", stated).tets.labels[0], 9);
  try {
    read_vtk(folder_.file("m"), VtkFormat::xml, "part", stated);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no cell array 'part', but 'label'"), std::string::npos)
        << error.what();
  }
}

TEST_F(VtkReading, WhatDoesNotGoTogetherIsRefused) {
  const std::string good = cells("0 1 2 3", "4", "10");
  for (const std::string& bad :
       {vtu(cells("0 1 2 9", "4", "10")), vtu(cells("0 1 2 -1", "4", "10")), vtu(cells("", "0", "10")),
        vtu(cells("0 1 2 3", "8", "10")), vtu(cells("0 1 2 3", "-4", "10")), vtu(cells("0 1 2 3", "4", "12")),
        vtu(cells("0 1 2", "4", "10")), vtu(cells("0 1 2 3", "", "10")), vtu(cells("0 1 2 3", "4", "")),
        vtu(good, "1.5"), vtu(good, "nan"), vtu(good, ""), vtu(good, "1", "nan 0 0 1 0 0 0 1 0 0 0 1"),
        vtu(good, "1", "0 0 0 1 0 0"), std::string("<VTKFile"), std::string()}) {
    EXPECT_NE(refusal_of(bad, VtkFormat::xml), "") << bad;
  }
}

/// Lengths that are cut and bytes that are changed: a mesh or one line, never a crash.
TEST_F(VtkReading, DamageEndsInALine) {
  std::mt19937 random(5);
  for (const auto& [name, format] :
       {std::pair{"d.vtu", VtkFormat::xml}, std::pair{"d.vtk", VtkFormat::legacy}}) {
    write_mesh(testing::one_of_each(), folder_.file(name));
    const std::string whole = folder_.content(name);
    for (int n = 0; n < 40; ++n) {
      std::string damaged = whole;
      if (n % 4 == 0) {
        damaged.resize(random() % whole.size());
      } else {
        damaged[random() % whole.size()] = static_cast<char>(random() % 256);
      }
      static_cast<void>(refusal_of(damaged, format));
    }
  }
}

}  // namespace
}  // namespace cbc3d

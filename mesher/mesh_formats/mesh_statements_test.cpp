// What text formats say of names, colours and coordinates: a round trip of each, and lines of other programs.
#include "mesher/mesh_formats/mesh_statements.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/mesh_format.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

TEST(MeshStatements, AreTakenAsTheyAreWritten) {
  MeshFileOptions written;
  written.coordinates = "RAS";
  written.names.set({.label = -5, .name = "Herz = \"Mitte\", links", .colour = {{200, 80, 8}}});
  written.names.set({.label = 7, .name = "", .colour = {{0, 255, 16}}});
  written.names.set({.label = 8, .name = "Milz", .colour = {}});
  written.names.set({.label = 9, .name = "of no cell", .colour = {}});
  MeshFileOptions stated;
  take_statement(" " + coordinates_statement(written), stated);
  for (const std::string& line : name_statements(written.names, {-5, 7, 8})) take_statement(line, stated);
  EXPECT_EQ(stated.coordinates, "RAS");
  ASSERT_EQ(stated.names.entries().size(), 3U);
  EXPECT_EQ(stated.names.find(-5)->name, "Herz = \"Mitte\", links");
  EXPECT_EQ(stated.names.find(-5)->colour, (std::array<std::uint8_t, 3>{200, 80, 8}));
  EXPECT_EQ(stated.names.find(7)->colour, (std::array<std::uint8_t, 3>{0, 255, 16}));
  EXPECT_EQ(stated.names.text(8), "Milz (8)");
  EXPECT_FALSE(stated.names.find(8)->colour);
}

TEST(MeshStatements, LinesOfOtherProgramsAreLeftAside) {
  MeshFileOptions stated;
  for (const char* const line :
       {"", "name", "name 5", "name five = x", "name 5x = y", "name 99999999999 = z", "colour 5 = red",
        "colour 5 = #12345", "colour 5 = #12345g", "coordinates in metres", "Name 5 = x", "a name 5 = x"}) {
    take_statement(line, stated);
  }
  EXPECT_TRUE(stated.names.empty());
  EXPECT_EQ(stated.coordinates, "LPS");
}

TEST(MeshStatements, GroupsNameLabelsThatHaveNone) {
  LabelNames names;
  names.set({.label = 1, .name = "right lung", .colour = {}});
  names.set({.label = 2, .name = "", .colour = {{1, 2, 3}}});
  take_group_name(1, "right_lung", names);
  take_group_name(2, "Volume2", names);
  take_group_name(3, "label_3", names);
  take_group_name(-4, "label_m4", names);
  take_group_name(5, " ", names);
  EXPECT_EQ(names.find(1)->name, "right lung");
  EXPECT_EQ(names.find(2)->name, "Volume2");
  EXPECT_TRUE(names.find(2)->colour);
  EXPECT_EQ(names.entries().size(), 2U);
}

/// Every format that is read says the same of one mesh.
TEST(MeshStatements, EveryFormatThatIsReadHasNamesColoursAndCoordinates) {
  const testing::TemporaryFolder folder("statements");
  for (const MeshFormat& format : mesh_formats()) {
    if (format.read == nullptr) continue;
    MeshFileOptions written;
    written.format = format.name;
    written.coordinates = "RAS";
    written.names.set({.label = 3, .name = "right lung, upper lobe", .colour = {{200, 80, 8}}});
    written.names.set({.label = 4, .name = "Übergang 7", .colour = {}});
    written.names.set({.label = 5, .name = "right-lung, upper lobe", .colour = {}});
    const auto file = folder.file("m" + std::string(format.extension));
    const Mesh mesh = testing::one_of_each();
    write_mesh(mesh, file, written);
    MeshFileOptions stated;
    const Mesh back = read_mesh(file, {}, nullptr, stated);
    EXPECT_EQ(stated.coordinates, "RAS") << format.name;
    EXPECT_NEAR((back.points[1] - Vec3{-mesh.points[1].x, -mesh.points[1].y, mesh.points[1].z}).norm(), 0,
                1e-11)
        << format.name << ": in memory they are LPS";
    ASSERT_EQ(stated.names.entries().size(), 3U) << format.name;
    for (const NamedLabel& named : written.names.entries()) {
      const NamedLabel* const found = stated.names.find(named.label);
      ASSERT_NE(found, nullptr) << format.name;
      EXPECT_EQ(found->name, named.name) << format.name;
      EXPECT_EQ(found->colour, named.colour) << format.name;
    }
    EXPECT_EQ(labels_of(back), labels_of(mesh)) << format.name;
  }
}

}  // namespace
}  // namespace cbc3d

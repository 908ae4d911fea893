// Names, colours and coordinates in VTK files: written, read back, and absent where there is nothing to say.
#include "mesher/mesh_formats/vtk_field_data.hpp"

#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include "mesher/core/testing_files.hpp"
#include "mesher/core/testing_mesh.hpp"

namespace cbc3d {
namespace {

class VtkFieldData : public testing::Files {};

MeshFileOptions statements() {
  MeshFileOptions options;
  options.names.set({.label = 3, .name = "right lung", .colour = std::array<std::uint8_t, 3>{200, 80, 0}});
  options.names.set({.label = 4,
                     .name = "H\xC3\xBC"
                             "fte, 50 % \"a\" <b>",
                     .colour = std::nullopt});
  return options;
}

TEST_F(VtkFieldData, NamesSurviveBothFormats) {
  for (const char* const name : {"m.vtu", "m.vtk"}) {
    write_mesh(testing::one_of_each(), file(name), statements());
    MeshFileOptions back;
    const Mesh mesh = read_mesh(file(name), {}, nullptr, back);
    EXPECT_EQ(mesh.points, testing::one_of_each().points);
    ASSERT_EQ(back.names.entries().size(), 2U) << name;
    EXPECT_EQ(back.names.entries()[0].name, "right lung");
    EXPECT_EQ(back.names.entries()[0].colour, (std::array<std::uint8_t, 3>{200, 80, 0}));
    EXPECT_EQ(back.names.entries()[1].name, statements().names.entries()[1].name);
    EXPECT_FALSE(back.names.entries()[1].colour);
    EXPECT_EQ(back.coordinates, "LPS");
  }
}

TEST_F(VtkFieldData, WithoutNamesThereIsNone) {
  write_mesh(testing::one_of_each(), file("a.vtu"));
  write_mesh(testing::one_of_each(), file("b.vtu"), {.names = {}, .coordinates = "LPS"});
  EXPECT_EQ(folder_.content("a.vtu"), folder_.content("b.vtu"));
  EXPECT_EQ(folder_.content("a.vtu").find("FieldData"), std::string::npos);
}

TEST_F(VtkFieldData, StatedCoordinatesAreTakenBackToLps) {
  ImageFrame frame;
  frame.spacing_mm = {2, 2, 2};
  for (const char* const name : {"m.vtu", "m.vtk"}) {
    write_mesh(testing::one_of_each(), file(name), {.names = {}, .coordinates = "RAS"});
    EXPECT_EQ(read_mesh(file(name)).points[1].x, -1.5) << name;
    write_mesh(testing::one_of_each(), file(name), {.names = {}, .coordinates = "voxel"});
    EXPECT_THROW(read_mesh(file(name)), InputError) << name;
    MeshFileOptions stated;
    EXPECT_EQ(read_mesh(file(name), {}, &frame, stated).points[1].x, 3) << name;
    EXPECT_EQ(stated.coordinates, "voxel");
  }
  EXPECT_NE(folder_.content("m.vtk").substr(0, 80).find("SPACE=voxel"), std::string::npos);
}

TEST_F(VtkFieldData, ArraysThatDoNotGoTogetherAreLeftAside) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkIntArray> values;
  vtkNew<vtkStringArray> names;
  values->SetName("label_values");
  names->SetName("label_names");
  values->InsertNextValue(1);
  values->InsertNextValue(2);
  names->InsertNextValue("a");
  grid->GetFieldData()->AddArray(values);
  grid->GetFieldData()->AddArray(names);
  EXPECT_TRUE(field_data_of(*grid).names.empty());
  names->InsertNextValue("b");
  EXPECT_EQ(field_data_of(*grid).names.text(2), "b (2)");
}

}  // namespace
}  // namespace cbc3d

#include "mesher/mesh_formats/mesh_format.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

TEST(MeshFormat, ExtensionsStandForTheFirstFormat) {
  EXPECT_EQ(format_of("a.msh").name, "gmsh22");
  EXPECT_EQ(format_of("a.msh", "gmsh41").name, "gmsh41");
  EXPECT_EQ(format_of("a.vtk").name, "vtk");
  EXPECT_EQ(format_of("a.vtk", "vtk-ascii").name, "vtk-ascii");
  EXPECT_EQ(mesh_formats().size(), mesh_format_names().size());
  EXPECT_EQ(written_extensions(), ".vtu, .vtk, .msh, .inp, .mesh, .feb or .xdmf");
  EXPECT_EQ(read_extensions(), ".vtu, .vtk, .msh, .inp or .mesh");
}

TEST(MeshFormat, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(format_of("a.stl"), InputError);
  EXPECT_THROW(format_of("a"), InputError);
  EXPECT_THROW(format_of("a.msh", "gmsh3"), InputError);
  EXPECT_THROW(format_of("a.vtu", "gmsh41"), InputError);
}

}  // namespace
}  // namespace cbc3d

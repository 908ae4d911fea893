// Surfaces: closed, outwards, named; read again by meshio and by VTK's readers of Python.
#include "mesher/mesh_formats/surface_files.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

/// The volume that a closed part encloses, positive where its normals point outwards.
double volume_of(const SurfaceMesh& surface, const SurfacePart& part) {
  double six = 0;
  for (const auto& t : part.triangles) {
    six += surface.points[t[0]].dot(surface.points[t[1]].cross(surface.points[t[2]]));
  }
  return six / 6;
}

LabelNames named() {
  LabelNames names;
  names.set({.label = 7, .name = "right lung", .colour = std::array<std::uint8_t, 3>{255, 0, 0}});
  return names;
}

TEST(SurfaceFiles, LabelsAreClosedAndOutwards) {
  const Mesh mesh = testing::two_label_box(2);
  const SurfaceMesh surface = surface_of(mesh, SurfaceParts::label, named());
  ASSERT_EQ(surface.parts.size(), 2U);
  EXPECT_EQ(surface.parts[0].name, "label_3");
  EXPECT_EQ(surface.parts[1].name, "right_lung");
  EXPECT_EQ(surface.parts[1].colour, (std::array<std::uint8_t, 3>{255, 0, 0}));
  EXPECT_NE(surface.parts[0].colour, surface.parts[1].colour);
  for (const SurfacePart& part : surface.parts) EXPECT_NEAR(volume_of(surface, part), 0.5, 1e-12);
}

TEST(SurfaceFiles, InterfacesAndAllHaveEveryFacetOnce) {
  const Mesh mesh = testing::two_label_box(2);
  const SurfaceMesh parts = surface_of(mesh, SurfaceParts::interface, {});
  ASSERT_EQ(parts.parts.size(), 3U);
  EXPECT_EQ(parts.parts[0].name, "label_3__label_7");
  EXPECT_EQ(parts.parts[0].triangles.size(), 8U);
  const SurfaceMesh all = surface_of(mesh, SurfaceParts::all, {});
  ASSERT_EQ(all.parts.size(), 1U);
  EXPECT_EQ(all.parts[0].triangles.size(), 56U);
}

TEST(SurfaceFiles, QuadrilateralsAreHalvedAlikeForBothLabels) {
  const Mesh mesh = testing::one_of_each();
  const SurfaceMesh surface = surface_of(mesh, SurfaceParts::label, {});
  std::multiset<std::set<VertexId>> triangles;
  for (const SurfacePart& part : surface.parts) {
    EXPECT_GT(volume_of(surface, part), 0) << part.name;
    for (const auto& t : part.triangles) triangles.insert({t.begin(), t.end()});
  }
  std::size_t shared = 0;
  for (const auto& triangle : triangles) shared += triangles.count(triangle) == 2 ? 1 : 0;
  EXPECT_GT(shared, 0U);
}

TEST(SurfaceFiles, RefusesOtherFormatsAndFolders) {
  EXPECT_THROW(require_writable_surface_path("a.vtu"), InputError);
  EXPECT_THROW(require_writable_surface_path("/nonexistent/a.stl"), InputError);
}

/// Prints the triangles and the volume inside of every file.
constexpr const char* kRead = R"(
import sys, json, vtk
readers = {'stl': vtk.vtkSTLReader, 'ply': vtk.vtkPLYReader, 'obj': vtk.vtkOBJReader, 'glb': vtk.vtkGLTFReader}
out = []
for name in sys.argv[1:]:
    reader = readers[name[-3:]]()
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutput()
    parts = [data]
    if name.endswith('glb'):
        it, parts = data.NewIterator(), []
        while not it.IsDoneWithTraversal():
            parts.append(it.GetCurrentDataObject())
            it.GoToNextItem()
    for part in parts:
        mass = vtk.vtkMassProperties()
        mass.SetInputData(part)
        signed = 0
        for c in range(part.GetNumberOfCells()):
            p = [part.GetPoint(part.GetCell(c).GetPointId(k)) for k in range(3)]
            signed += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0])
                       + p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) / 6
        out.append([part.GetNumberOfCells(), signed])
print(json.dumps(out))
)";

TEST(SurfaceFiles, VtkReadsTheSameTriangles) {
  if (testing::run_program("/usr/bin/python3 -c 'import vtk; vtk.vtkGLTFReader'").exit_code != 0) {
    GTEST_SKIP() << "python3-vtk9 is not installed";
  }
  const testing::TemporaryFolder folder("surface");
  folder.write("read.py", kRead);
  const SurfaceMesh surface = surface_of(testing::two_label_box(2), SurfaceParts::label, named());
  std::string files;
  for (const char* name : {"m.stl", "m.ply", "m.obj", "m.glb"}) {
    for (const auto& file : write_surface(surface, folder.file(name))) files += " '" + file.string() + "'";
  }
  EXPECT_NE(files.find("m-right_lung.stl"), std::string::npos) << files;
  const auto outcome =
      testing::run_program("/usr/bin/python3 '" + folder.file("read.py").string() + "'" + files);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto found = nlohmann::json::parse(outcome.text.substr(outcome.text.find("[[")));
  ASSERT_EQ(found.size(), 7U) << found;
  for (std::size_t f = 0; f < found.size(); ++f) {
    const bool whole = f == 4;             // OBJ has both labels
    const double unit = f > 4 ? 1e-9 : 1;  // glTF has metres
    EXPECT_EQ(found[f][0], whole ? 64 : 32) << found;
    EXPECT_NEAR(found[f][1].get<double>(), (whole ? 1 : 0.5) * unit, 1e-6 * unit) << found;
  }
}

TEST(SurfaceFiles, MeshioReadsTheSameTriangles) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const testing::TemporaryFolder folder("surface");
  const SurfaceMesh surface = surface_of(testing::two_label_box(2), SurfaceParts::all, {});
  for (const char* name : {"m.stl", "m.ply", "m.obj"}) {
    ASSERT_EQ(write_surface(surface, folder.file(name)).size(), 1U);
    EXPECT_EQ(testing::reopened(folder.file(name))["cells"]["triangle"], 56) << name;
  }
}

}  // namespace
}  // namespace cbc3d

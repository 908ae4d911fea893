// Mesh files of any bytes: a sound mesh or an InputError. The first byte chooses the reader: g Gmsh, a
// Abaqus, m Medit, x VTK's XML, l VTK's legacy format, whose readers work in a child process.
#include <cstdint>
#include <cstdlib>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/abaqus_reading.hpp"
#include "mesher/mesh_formats/gmsh_reading.hpp"
#include "mesher/mesh_formats/medit_reading.hpp"
#include "mesher/mesh_formats/vtk_reading.hpp"
#include "mesher/testing/fuzz_file.hpp"

namespace {

cbc3d::Mesh read_by(char reader, const std::filesystem::path& path) {
  cbc3d::MeshFileOptions stated;
  switch (reader) {
    case 'a':
      return cbc3d::read_abaqus(path, {});
    case 'm':
      return cbc3d::read_medit(path, {});
    case 'x':
      return cbc3d::read_vtk(path, cbc3d::VtkFormat::xml, "", stated);
    case 'l':
      return cbc3d::read_vtk(path, cbc3d::VtkFormat::legacy, "", stated);
    default:
      return cbc3d::read_gmsh(path, {});
  }
}

template <typename Block>
void require_nodes_within(const Block& block, std::size_t points) {
  for (const auto& nodes : block.nodes) {
    for (const cbc3d::VertexId v : nodes) {
      if (v >= points) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const cbc3d::testing::FuzzFile file(bytes + 1, size - 1);
  try {
    const cbc3d::Mesh mesh = read_by(static_cast<char>(bytes[0]), file.path());
    const std::size_t points = mesh.points.size();
    if (mesh.cell_count() == 0) std::abort();
    require_nodes_within(mesh.tets, points);
    require_nodes_within(mesh.pyramids, points);
    require_nodes_within(mesh.wedges, points);
    require_nodes_within(mesh.hexes, points);
  } catch (const cbc3d::InputError&) {
    return 0;
  }
  return 0;
}

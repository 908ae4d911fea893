// Gmsh's .msh format, versions 2.2 and 4.1, as text and binary.
#pragma once

#include <filesystem>

#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// The label of a cell is its physical group, 0 without one; with the label array "gmsh:geometrical" it is
/// the number of its volume in the geometry. Throws InputError, which names the line, or the byte of binary
/// data. `stated` becomes what $Comments of our files say; labels that they do not name have the names of
/// their physical groups.
Mesh read_gmsh(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated);
Mesh read_gmsh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

}  // namespace cbc3d

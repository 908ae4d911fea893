// XDMF 3 (xdmf.org, "XDMF Model and Format"), everything as text in the one file, so that ParaView, FEniCS's
// and meshio's readers take it without HDF5.
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Writes to exactly this path: cells with the attribute "label"; names, colours and coordinates as
/// comments. Throws JobError when writing fails.
void write_xdmf(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

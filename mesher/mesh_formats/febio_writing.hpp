// FEBio's input format 4.0 (FEBio User Manual, "Free format input"): Mesh with one Elements section for each
// label and kind of cell, one Surface for each interface, and MeshDomains. Every label has a material to be
// replaced.
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Writes to exactly this path. Throws JobError when writing fails.
void write_febio(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

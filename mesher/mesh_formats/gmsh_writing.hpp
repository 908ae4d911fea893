// Gmsh's .msh format as text, versions 2.2 and 4.1 (Gmsh Reference Manual, "File formats").
//
// Labels are physical volumes, interfaces physical surfaces, both named. Physical surface n is interface n of
// the mesh; from the other side of a split mesh it is number n + interfaces.
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Gmsh's physical groups have positive numbers: throws InputError where a label is none.
void require_gmsh_labels(const std::vector<Label>& labels);

/// Write to exactly this path (the caller makes it atomic). Throw InputError for labels that are not
/// positive, JobError when writing fails.
void write_gmsh22(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);
void write_gmsh41(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

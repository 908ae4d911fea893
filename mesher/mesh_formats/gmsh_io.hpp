// Gmsh's .msh format, version 2.2 text: read by Gmsh, meshio and most solvers' converters.
#pragma once

#include <filesystem>

#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// Gmsh's physical groups have positive numbers: throws InputError where a label is none.
void require_gmsh_labels(const std::vector<Label>& labels, const std::filesystem::path& path);

/// Writes to exactly this path (the caller makes it atomic). Labels become physical groups with the names'
/// identifiers. Gmsh's physical tags are positive, so a mesh with a label <= 0 is refused with InputError.
/// Throws JobError when writing fails.
void write_gmsh(const Mesh& mesh, const std::filesystem::path& path, const LabelNames& names = {});

/// Reads version 2.2 text files; the first tag (physical group) is the label. Throws InputError.
Mesh read_gmsh(const std::filesystem::path& path);

}  // namespace cbc3d

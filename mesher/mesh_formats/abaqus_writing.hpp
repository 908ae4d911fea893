// Abaqus's input format, which CalculiX reads too (Abaqus Keywords Reference; CalculiX 2.20 User's Manual):
// nodes, one element set for each label, one surface of element faces for each interface. It is a mesh
// without materials, steps and loads: *INCLUDE it in an analysis.
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Writes to exactly this path. Coordinates have twelve digits, for CalculiX reads twenty characters of a
/// number. Pyramids are C3D5, which CalculiX does not know. Throws JobError when writing fails.
void write_abaqus(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

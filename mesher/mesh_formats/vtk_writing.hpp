// VTK's formats, written by VTK: XML (.vtu) and legacy 4.2 (.vtk), which Slicer and SOFA read. The cells have
// the integer array "label".
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Write to exactly this path. Throw JobError when writing fails.
void write_vtu(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);
void write_vtk(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);
void write_vtk_text(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

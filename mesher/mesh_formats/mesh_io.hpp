// Reading and writing meshes: .vtu (VTK XML), .vtk (VTK legacy 4.2, which Slicer and SOFA read), .msh
// (Gmsh 2.2 text).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// What a mesh file says beside points and cells.
struct MeshFileOptions {
  LabelNames names{};  ///< names of groups, parts and sets; a label without one is "label_N"
  std::string coordinates =
      "LPS";  ///< what the points are given in, written into the file: LPS, RAS or voxel
};

/// Checks, before any long work, that a mesh could be written to `path`: a known extension and a folder that
/// can be written to. Throws InputError.
void require_writable_mesh_path(const std::filesystem::path& path);

/// Checks, before any long work, that the format of `path` can hold these labels: Gmsh's physical groups are
/// positive. Throws InputError.
void require_writable_labels(const std::vector<Label>& labels, const std::filesystem::path& path);

/// Writes `mesh` in the format of the extension, cells carrying the integer array "label". The file appears
/// under its final name only when it is complete. Throws InputError when the format is unknown, JobError when
/// writing fails.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options = {});

/// Reads a mesh; the cell array "label" (for .msh the first tag) gives the labels. Other arrays are ignored,
/// cells of lower dimension too. Throws InputError naming the file and the remedy.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace cbc3d

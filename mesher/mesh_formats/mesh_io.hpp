// Reading and writing meshes in all formats of mesh_format.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {

/// What a mesh file says beside points and cells.
struct MeshFileOptions {
  LabelNames names{};  ///< names of groups, parts and sets; a label without one is "label_N"
  std::string coordinates =
      "LPS";                      ///< what the points are given in, written into the file: LPS, RAS or voxel
  std::string format{};           ///< one of mesh_format_names(); empty: what the extension stands for
  bool split_interfaces = false;  ///< every label has nodes of its own at its interfaces
};

struct ReadMeshOptions {
  /// The cell array with the labels, empty for the format's own: of VTK's formats "label", of Gmsh's
  /// "gmsh:physical" (the other is "gmsh:geometrical"); the other formats have one alone.
  std::string label_array{};
};

/// "vtu", "vtk", ...: what MeshFileOptions::format may be.
std::vector<std::string> mesh_format_names();

/// The extensions of the formats that are written, or read, for messages and help: ".vtu, .vtk, .msh or
/// .mesh".
std::string written_extensions();
std::string read_extensions();

/// Checks, before any long work, that a mesh could be written to `path`: a known extension, a format that
/// goes with it, and a folder that can be written to. Throws InputError.
void require_writable_mesh_path(const std::filesystem::path& path, const MeshFileOptions& options = {});

/// Checks, before any long work, that the format of `path` can hold these labels: Gmsh's physical groups are
/// positive. Throws InputError.
void require_writable_labels(const std::vector<Label>& labels, const std::filesystem::path& path);

/// Writes `mesh` in the format of the options or the extension; cells carry their labels, interfaces are
/// named where the format has them. The file appears under its final name only when it is complete. Throws
/// InputError when the format is unknown or cannot hold the mesh, JobError when writing fails.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options = {});
void write_mesh(const QuadraticMesh& mesh, const std::filesystem::path& path,
                const MeshFileOptions& options = {});

/// Reads a mesh with the labels of its cells. Other arrays are ignored, cells of lower dimension too. Throws
/// InputError naming the file, the place and the remedy.
/// The points become LPS mm where the file states other coordinates; voxel coordinates are refused.
Mesh read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

/// The same; `stated` becomes what the file says of names, colours and coordinates. `frame` (or null) is that
/// of the image which voxel coordinates are of.
Mesh read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options, const ImageFrame* frame,
               MeshFileOptions& stated);

}  // namespace cbc3d

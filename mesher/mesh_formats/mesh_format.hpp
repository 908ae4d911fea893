// The table of formats of volume meshes: one row for each.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

struct MeshFormat {
  std::string_view name;       ///< of the parameter format
  std::string_view extension;  ///< with its dot; the first format with an extension is what it stands for
  bool interfaces = false;     ///< facets between labels as named groups
  bool positive_labels = false;
  void (*write)(const FileMesh&, const std::filesystem::path&, const MeshFileOptions&) = nullptr;
  /// Points as the file has them, and what it states of names and coordinates. Null for a format that is
  /// written alone.
  Mesh (*read)(const std::filesystem::path&, const ReadMeshOptions&, MeshFileOptions& stated) = nullptr;
};

std::span<const MeshFormat> mesh_formats();

/// The format named `name`, or, where that is empty, the first of the path's extension. Throws InputError for
/// an unknown extension or name, and for a name that goes with another extension.
const MeshFormat& format_of(const std::filesystem::path& path, const std::string& name = {});

}  // namespace cbc3d

// The options by which commands say how a mesh's file is read and written.
#pragma once

#include <CLI/CLI.hpp>

#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Adds --format and --split-interfaces.
void add_mesh_file_options(CLI::App& command, MeshFileOptions& options);

/// Adds --label-array.
void add_label_array_option(CLI::App& command, ReadMeshOptions& options);

/// "mesh file: .vtu, .vtk, ..." for the help of --out, and the same of a mesh that is read.
std::string written_mesh_text();
std::string read_mesh_text(const std::string& what);

}  // namespace cbc3d

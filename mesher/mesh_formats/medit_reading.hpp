// Medit's .mesh format as text.
#pragma once

#include <filesystem>

#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// The reference of a cell is its label. Throws InputError, which names the line; a file without its End is
/// truncated. `stated` becomes what the comments of our files say.
Mesh read_medit(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated);
Mesh read_medit(const std::filesystem::path& path, const ReadMeshOptions& options = {});

}  // namespace cbc3d

// Medit's .mesh format as text (Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253,
// 2001), which Mmg and FreeFEM read. References of volumes are labels; those of facets are the numbers of the
// interfaces from 1 on, which a comment names. Quadratic tets are the sections TetrahedraP2 and TrianglesP2
// of libMeshb.
#pragma once

#include <filesystem>

#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Writes to exactly this path. Throws JobError when writing fails.
void write_medit(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace cbc3d

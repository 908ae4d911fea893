// Abaqus's and CalculiX's input format, as far as it is a mesh.
#pragma once

#include <filesystem>

#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Element sets are labels: those that *ELEMENT names, or, where it names none, those of *ELSET. A set's
/// number is that of our comment "** LABEL 5 = liver", or the one at the end of its name ("label_5",
/// "Volume3") where all sets' names have different ones, or its place among the sets of volumes; without any
/// set the label is 1. Throws InputError, which names the line. `stated` becomes what the heading and
/// comments of our files say; labels that they do not name have the names of their sets.
Mesh read_abaqus(const std::filesystem::path& path, const ReadMeshOptions& options, MeshFileOptions& stated);
Mesh read_abaqus(const std::filesystem::path& path, const ReadMeshOptions& options = {});

}  // namespace cbc3d

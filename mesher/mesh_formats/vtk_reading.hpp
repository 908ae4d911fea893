// VTK's readers, which fail on damaged files, kept apart from everything else.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

enum class VtkFormat { xml, legacy };

/// Reads an unstructured grid by VTK in a child process, whose memory and time are limited by the size of the
/// file, and checks what comes of it. `label_array`: the cell array with the labels; empty: "label". `stated`
/// becomes what its field data and, of a legacy file, its title say (vtk_field_data.hpp). Throws InputError:
/// one line, whatever the reader does.
Mesh read_vtk(const std::filesystem::path& path, VtkFormat format, const std::string& label_array,
              MeshFileOptions& stated);

}  // namespace cbc3d

#include "mesher/mesh_formats/mesh_format.hpp"

#include <array>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/abaqus_reading.hpp"
#include "mesher/mesh_formats/abaqus_writing.hpp"
#include "mesher/mesh_formats/febio_writing.hpp"
#include "mesher/mesh_formats/gmsh_reading.hpp"
#include "mesher/mesh_formats/gmsh_writing.hpp"
#include "mesher/mesh_formats/medit_reading.hpp"
#include "mesher/mesh_formats/medit_writing.hpp"
#include "mesher/mesh_formats/vtk_reading.hpp"
#include "mesher/mesh_formats/vtk_writing.hpp"
#include "mesher/mesh_formats/xdmf_writing.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;

Mesh read_vtu(const fs::path& path, const ReadMeshOptions& options, MeshFileOptions& stated) {
  return read_vtk(path, VtkFormat::xml, options.label_array, stated);
}

Mesh read_legacy_vtk(const fs::path& path, const ReadMeshOptions& options, MeshFileOptions& stated) {
  return read_vtk(path, VtkFormat::legacy, options.label_array, stated);
}

/// name, extension, interfaces, positive labels alone, writer, reader
constexpr std::array<MeshFormat, 9> kFormats = {{
    {"vtu", ".vtu", false, false, write_vtu, read_vtu},
    {"vtk", ".vtk", false, false, write_vtk, read_legacy_vtk},
    {"vtk-ascii", ".vtk", false, false, write_vtk_text, read_legacy_vtk},
    {"gmsh22", ".msh", true, true, write_gmsh22, read_gmsh},
    {"gmsh41", ".msh", true, true, write_gmsh41, read_gmsh},
    {"abaqus", ".inp", true, false, write_abaqus, read_abaqus},
    {"medit", ".mesh", true, false, write_medit, read_medit},
    {"febio", ".feb", true, false, write_febio, nullptr},
    {"xdmf", ".xdmf", false, false, write_xdmf, nullptr},
}};

std::string list_of(std::vector<std::string> words) {
  std::string text;
  for (std::size_t w = 0; w < words.size(); ++w) {
    text += (w == 0 ? "" : w + 1 == words.size() ? " or " : ", ") + words[w];
  }
  return text;
}

std::string extensions(bool read_alone) {
  std::vector<std::string> found;
  for (const MeshFormat& format : kFormats) {
    const std::string extension(format.extension);
    if ((format.read != nullptr || !read_alone) && (found.empty() || found.back() != extension)) {
      found.push_back(extension);
    }
  }
  return list_of(found);
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  return kFormats;
}

std::vector<std::string> mesh_format_names() {
  std::vector<std::string> names;
  names.reserve(kFormats.size());
  for (const MeshFormat& format : kFormats) names.emplace_back(format.name);
  return names;
}

std::string written_extensions() {
  return extensions(false);
}

std::string read_extensions() {
  return extensions(true);
}

const MeshFormat& format_of(const fs::path& path, const std::string& name) {
  const std::string extension = path.extension().string();
  for (const MeshFormat& format : kFormats) {
    if (name.empty() ? format.extension == extension : format.name == name) {
      if (format.extension == extension) return format;
      throw InputError("'" + path.string() + "': the format " + name + " has the extension " +
                       std::string(format.extension) + ", not '" + extension + "'; name the file so");
    }
  }
  if (!name.empty()) {
    throw InputError("format '" + name + "' is unknown; give " + list_of(mesh_format_names()), "format");
  }
  throw InputError("'" + path.string() + "': unknown mesh format '" + extension + "'; use " +
                   written_extensions());
}

}  // namespace cbc3d

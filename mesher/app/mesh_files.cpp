#include "mesher/app/mesh_files.hpp"

#include "mesher/mesh_formats/output_texts.hpp"

namespace cbc3d {

void add_mesh_file_options(CLI::App& command, MeshFileOptions& options) {
  command
      .add_option("--format", options.format,
                  "format of the mesh's file, where an extension stands for several: .vtk is vtk (binary) or "
                  "vtk-ascii, "
                  ".msh gmsh22 or gmsh41 [the first]")
      ->check(CLI::IsMember(mesh_format_names()));
  command.add_flag("--split-interfaces", options.split_interfaces, kSplitInterfacesText);
}

void add_label_array_option(CLI::App& command, ReadMeshOptions& options) {
  command
      .add_option("--label-array", options.label_array,
                  "cell array of the mesh that has the labels: of .vtu and .vtk any [label], of .msh "
                  "gmsh:physical or "
                  "gmsh:geometrical [gmsh:physical]")
      ->type_name("NAME");
}

std::string written_mesh_text() {
  return "mesh file: " + written_extensions();
}

std::string read_mesh_text(const std::string& what) {
  return what + ": " + read_extensions();
}

}  // namespace cbc3d

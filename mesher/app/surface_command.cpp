#include "mesher/app/surface_command.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "mesher/app/coordinates_option.hpp"
#include "mesher/app/mesh_files.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/mesh_formats/surface_files.hpp"

namespace cbc3d {
namespace {

const std::map<std::string, SurfaceParts> kParts = {
    {"label", SurfaceParts::label}, {"interface", SurfaceParts::interface}, {"all", SurfaceParts::all}};

struct SurfaceCommand {
  std::string mesh, image, out, per = "label";
  std::string coordinates = MeshFileOptions{}.coordinates;
  ReadMeshOptions reading;
  CommonOptions common;
};

SurfaceMesh surface_of(const SurfaceCommand& command) {
  MeshFileOptions stated;
  std::optional<ImageFrame> frame;
  if (!command.image.empty()) frame = read_label_image(command.image).frame;
  const ImageFrame* const of_image = frame ? &*frame : nullptr;
  Mesh mesh = read_mesh(command.mesh, command.reading, of_image, stated);
  try {
    from_lps(mesh, command.coordinates, of_image);
    return surface_of(mesh, kParts.at(command.per), stated.names);
  } catch (const InputError& error) {
    throw InputError("'" + command.mesh + "': " + error.what());
  }
}

void run(const SurfaceCommand& command) {
  require_writable_surface_path(command.out);
  if (command.image.empty() && command.coordinates == "voxel") {
    throw InputError("--coordinates voxel needs the image that the indices are of; name it by --image");
  }
  TerminalProgress progress(command.common.quiet);
  progress.step("reading " + command.mesh, 0);
  const SurfaceMesh surface = surface_of(command);
  progress.step("writing " + command.out, 0.5);
  const auto files = write_surface(surface, command.out, command.coordinates);
  progress.done();
  std::size_t triangles = 0;
  for (const SurfacePart& part : surface.parts) triangles += part.triangles.size();
  for (const auto& file : files) progress.line("wrote " + file.string());
  progress.line(std::to_string(surface.parts.size()) + " parts, " + std::to_string(triangles) + " triangles");
}

}  // namespace

void add_surface_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<SurfaceCommand>();
  CLI::App* surface = app.add_subcommand("surface", "the surfaces of a labelled volume mesh as triangles");
  surface->add_option("mesh", command->mesh, read_mesh_text("labelled volume mesh"))->required();
  surface
      ->add_option(
          "-o,--out", command->out,
          "surface file: .obj and .glb have all parts in one, .stl and .ply one each, whose name is then "
          "OUT-PART.stl")
      ->required();
  surface
      ->add_option(
          "--per", command->per,
          "label: a part for each label, normals outwards; interface: one for each pair of labels and each "
          "outer surface, normals out of the lower label; all: every facet once, in one part [label]")
      ->check(CLI::IsMember({"label", "interface", "all"}));
  add_label_array_option(*surface, command->reading);
  add_coordinates_option(*surface, command->coordinates);
  surface->add_option(
      "--image", command->image,
      "the image of the mesh, whose frame voxel coordinates need: those asked for, and those that "
      "the mesh's file states");
  complete_command(*surface, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d

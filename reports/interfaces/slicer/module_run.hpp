// The module's work: a label map's file to a model's file, with the progress that Slicer reads.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "mesher/input/image_input.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d::slicer {

struct ModuleRun {
  std::filesystem::path label_map, model;
  std::string preset;
  OptionSettings settings;
  ImageInput input;         ///< what of the label map is meshed
  int order = 1;            ///< 2: tets of ten nodes
  MeshFileOptions writing;  ///< nodes of interfaces; names are the label map's
};

/// Meshes, and writes to `out` the lines by which a command line module of Slicer reports its progress.
/// Returns the warnings. Throws InputError and JobError.
std::vector<std::string> run_module(ModuleRun& run, std::ostream& out);

/// Makes the title of a legacy .vtk file say that its coordinates are LPS, as Slicer's own files do.
void state_lps(const std::filesystem::path& file);

}  // namespace cbc3d::slicer

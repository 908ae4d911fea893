#include "mesher/app/deform_command.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "mesher/app/coordinates_option.hpp"
#include "mesher/app/flag_names.hpp"
#include "mesher/app/mesh_files.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_flags.hpp"
#include "mesher/app/option_json.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/core/mesh_placement.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_json.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

struct DeformCommand {
  std::string mesh, image, out;
  std::string preset = preset_names().front();
  OptionSettings settings;
  ReadMeshOptions reading;
  MeshFileOptions writing;
  ImageInput input;
  CommonOptions common;
};

MeshImageOptions options_of(const DeformCommand& command, const LabelImage& image) {
  MeshImageOptions options = deformation_preset_options(command.preset);
  apply_settings(command.settings, options);
  require_known_labels(options, image);
  // A mesh from a file may be deformed already, so that no tet of it is red to the last digit.
  options.mix.red_only = false;
  options.mix.min_scaled_jacobian = options.deform.quality.min_scaled_jacobian;
  return options;
}

void write_report(const DeformCommand& command, const MeshImageOptions& options, const MixReport& mix,
                  const DeformReport& deform, const Mesh& mesh) {
  nlohmann::json json = {{"status", "ok"},
                         {"reason", ""},
                         {"version", CBC3D_VERSION},
                         {"label_names", names_json(command.input.names)},
                         {"coordinates", command.writing.coordinates},
                         {"input", chosen_json(command.input)},
                         {"options", options_json(options, deformation_preset_options(command.preset),
                                                  {OptionGroup::mixed, OptionGroup::deformation})},
                         {"counts", counts_json(mesh)},
                         {"mixed_elements", options.mixed ? mix_json(mix) : nlohmann::json()},
                         {"deformation", deformation_json(deform)},
                         {"warnings", command.input.warnings},
                         {"peak_rss_bytes", process_peak_rss_bytes()}};
  add_names(json, command.input.names);
  write_text_file(command.common.report_file, json_text(json) + "\n");
}

/// The mesh in the image's frame. Throws InputError where they do not lie together.
MaterialMesh read_material_mesh(DeformCommand& command, const LabelImage& image) {
  MeshFileOptions stated;
  const Mesh mesh = read_mesh(command.mesh, command.reading, &image.frame, stated);
  command.input.names.add_unknown(stated.names);
  require_writable_labels(labels_of(mesh), command.out);
  try {
    MaterialMesh local = to_material_mesh(mesh, image);  // labels that the image lacks are named first
    const Placement placement = placement_of(mesh, image);
    if (placement.elsewhere) {
      throw InputError(placement.finding);
    }
    if (!placement.finding.empty()) {
      command.input.warnings.push_back(placement.finding);
    }
    return local;
  } catch (const InputError& error) {
    throw InputError("'" + command.mesh + "': " + error.what());
  }
}

void run(DeformCommand& command) {
  require_writable_mesh_path(command.out, command.writing);
  TerminalProgress progress(command.common.quiet);
  progress.step("reading " + command.mesh, 0);
  const LabelImage image = read_input_image(command.image, command.input);
  const MeshImageOptions options = options_of(command, image);
  MaterialMesh mesh = read_material_mesh(command, image);
  MixReport mix;
  if (options.mixed) {
    progress.step("mixed elements", 0.1);
    mix = mix_elements(mesh, options.mix);
  }
  const DeformReport deform = deform_mesh(mesh, image, options.deform, [&](int i) {
    progress.step("deformation, iteration " + std::to_string(i + 1),
                  0.2 + 0.7 * i / std::max(1, options.deform.iterations));
  });
  progress.step("writing " + command.out, 0.95);
  Mesh out = to_physical_mesh(mesh, image);
  command.writing.names = command.input.names;
  from_lps(out, command.writing.coordinates, &image.frame);
  write_mesh(out, command.out, command.writing);
  if (!command.common.report_file.empty()) {
    write_report(command, options, mix, deform, out);
  }
  progress.done();
  for (const std::string& warning : command.input.warnings) {
    progress.line("warning: " + with_names(with_flags(warning), command.input.names), true);
  }
  if (deform.stopped_early) {
    progress.line("warning: the deformation stopped after " + std::to_string(deform.iterations.size()) +
                      " iterations: elements stay below the minimum quality; --on-failure recover goes on",
                  true);
  }
  progress.line("wrote " + command.out + ": " + counts_text(out));
}

}  // namespace

void add_deform_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<DeformCommand>();
  CLI::App* deform = app.add_subcommand("deform",
                                        "the deformation alone, on a given mesh with cell labels; with "
                                        "--mixed --iterations 0 the mixed elements alone");
  deform->add_option("mesh", command->mesh, read_mesh_text("mesh of tets, pyramids, hexes"))->required();
  deform->add_option("image", command->image, "label image that the mesh was made from")->required();
  deform->add_option("-o,--out", command->out, written_mesh_text())->required();
  deform
      ->add_option("--preset", command->preset,
                   "quality: our best; paper: the published method [" + command->preset + "]")
      ->check(CLI::IsMember(preset_names()));
  for (const OptionGroup group : {OptionGroup::mixed, OptionGroup::deformation}) {
    add_option_flags(*deform, group, deformation_columns(), command->settings);
  }
  add_coordinates_option(*deform, command->writing.coordinates);
  add_mesh_file_options(*deform, command->writing);
  add_label_array_option(*deform, command->reading);
  add_input_options(*deform, InputScope::image, command->input);
  add_report_option(*deform, command->common, "JSON file with options, counts and per-iteration figures");
  complete_command(*deform, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d

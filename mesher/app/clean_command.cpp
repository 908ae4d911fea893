#include "mesher/app/clean_command.hpp"

#include <memory>

#include "mesher/app/flag_names.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_flags.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_json.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

struct CleanCommand {
  std::string image;
  std::string out;
  std::string preset = preset_names().front();
  OptionSettings settings;
  ImageInput input;
  CommonOptions common;
};

void run(CleanCommand& command) {
  require_writable_image_path(command.out);
  TerminalProgress progress(command.common.quiet);
  progress.step("reading " + command.image, 0);
  LabelImage image = read_input_image(command.image, command.input);
  MeshImageOptions options = preset_options(command.preset, image.frame);
  apply_settings(command.settings, options);
  progress.step("cleaning", 0.3);
  const CleanReport report = clean_image(image, options.clean, false);
  progress.step("writing " + command.out, 0.7);
  write_label_image(image, command.out);
  nlohmann::json json = cleaning_json(report, image.frame);
  json["warnings"] = command.input.warnings;
  json["input"] = chosen_json(command.input);
  json["label_names"] = names_json(command.input.names);
  add_names(json, command.input.names);
  if (!command.common.report_file.empty()) {
    write_text_file(command.common.report_file, json_text(json) + "\n");
  }
  progress.done();
  for (const std::string& warning : command.input.warnings) {
    progress.line("warning: " + with_flags(warning), true);
  }
  for (const LabelChange& change : report.labels) {
    if (change.voxels_before != change.voxels_after) {
      progress.line(command.input.names.text(change.label) + ": " + std::to_string(change.voxels_before) +
                        " -> " + std::to_string(change.voxels_after) + " voxels",
                    change.voxels_after == 0);
    }
  }
  progress.line("wrote " + command.out + ": " + std::to_string(report.contacts.vertex_contacts) +
                " vertex and " + std::to_string(report.contacts.edge_contacts) + " edge contacts removed, " +
                std::to_string(report.removed.regions_removed) + " small regions removed");
}

}  // namespace

void add_clean_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<CleanCommand>();
  CLI::App* clean = app.add_subcommand("clean", "the image pre-processing alone");
  clean->add_option("image", command->image, kImageFormats)->required();
  clean->add_option("-o,--out", command->out, "label image: .nii, .nii.gz, .nrrd or .mha")->required();
  clean
      ->add_option("--preset", command->preset,
                   "whose pre-processing: quality or paper [" + command->preset + "]")
      ->check(CLI::IsMember(preset_names()));
  add_option_flags(*clean, OptionGroup::cleaning, preset_columns(), command->settings);
  add_input_options(*clean, InputScope::image, command->input);
  add_report_option(*clean, command->common, "JSON file with what was changed");
  complete_command(*clean, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d

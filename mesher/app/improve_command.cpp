#include "mesher/app/improve_command.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "mesher/app/coordinates_option.hpp"
#include "mesher/app/flag_names.hpp"
#include "mesher/app/mesh_files.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_flags.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_json.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/improve_given_mesh.hpp"

namespace cbc3d {
namespace {

struct ImproveCommand {
  std::string mesh, image, out;
  MeshImageOptions defaults{.improve = given_mesh_defaults()};
  OptionSettings settings;
  ReadMeshOptions reading;
  MeshFileOptions writing;
  double max_deviation_mm = 0;
  bool decimate = false;
  ImageInput input;
  CommonOptions common;
};

std::string text_of(const char* format, double a, double b) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

ImproveGivenMeshOptions options_of(const ImproveCommand& command) {
  MeshImageOptions options = command.defaults;
  apply_settings(command.settings, options);
  return {
      .improve = options.improve, .max_deviation_mm = command.max_deviation_mm, .decimate = command.decimate};
}

/// What the improvement gives, and the image that it was given.
struct Improved {
  Mesh mesh;
  std::optional<LabelImage> image;

  /// Null where no image was given.
  [[nodiscard]] const ImageFrame* frame() const { return image ? &image->frame : nullptr; }
};

/// Reads, improves and adds what was found while reading to the report's warnings.
Improved improved_mesh(ImproveCommand& command, const Progress& progress, ImproveGivenMeshReport& report) {
  progress.step("reading " + command.mesh, 0);
  Improved result;
  if (!command.image.empty()) {
    result.image = read_input_image(command.image, command.input);
    report.warnings = command.input.warnings;
  }
  MeshFileOptions stated;
  Mesh mesh = read_mesh(command.mesh, command.reading, result.frame(), stated);
  require_writable_labels(labels_of(mesh), command.out);
  command.input.names.add_unknown(stated.names);
  try {
    result.mesh = improve_given_mesh(std::move(mesh), result.image ? &*result.image : nullptr,
                                     options_of(command), progress, report);
  } catch (const InputError& error) {
    throw InputError("'" + command.mesh + "': " + error.what());
  }
  for (std::string& warning : report.warnings) {
    warning = with_names(with_flags(warning), command.input.names);
  }
  return result;
}

nlohmann::json measures_json(const TetMeasures& m) {
  return {{"vertices", m.vertices},
          {"tets", m.tets},
          {"not_positive", m.not_positive},
          {"min_dihedral_deg", m.min_dihedral_deg},
          {"max_dihedral_deg", m.max_dihedral_deg}};
}

nlohmann::json volumes_json(const ImproveGivenMeshReport& report) {
  nlohmann::json labels = nlohmann::json::array();
  for (std::size_t m = 1; m < report.labels.size(); ++m) {
    labels.push_back({{"label", report.labels[m]},
                      {"volume_before_mm3", report.before.volume_mm3[m]},
                      {"volume_after_mm3", report.after.volume_mm3[m]}});
  }
  return labels;
}

nlohmann::json report_json(const ImproveCommand& command, const ImproveGivenMeshReport& report) {
  nlohmann::json stages = nlohmann::json::array();
  for (const auto& [name, seconds] : report.improve.part_seconds) {
    stages.push_back({{"name", name}, {"seconds", seconds}});
  }
  nlohmann::json json = {
      {"status", "ok"},
      {"reason", ""},
      {"version", CBC3D_VERSION},
      {"label_names", names_json(command.input.names)},
      {"coordinates", command.writing.coordinates},
      {"input", chosen_json(command.input)},
      {"options",
       {{"min_dihedral_deg", options_of(command).improve.min_dihedral_deg},
        {"max_deviation_mm", report.max_deviation_mm},
        {"decimation", command.decimate},
        {"image", command.image},
        {"threads", command.common.threads}}},
      {"before", measures_json(report.before)},
      {"after", measures_json(report.after)},
      {"labels", volumes_json(report)},
      {"orientation", {{"degenerate", report.orient.degenerate}, {"turned", report.orient.turned}}},
      {"seconds", {{"improve", report.seconds}, {"stages", stages}}},
      {"warnings", report.warnings},
      {"peak_rss_bytes", process_peak_rss_bytes()}};
  add_names(json, command.input.names);
  return json;
}

void run(ImproveCommand& command) {
  require_writable_mesh_path(command.out, command.writing);
  if (command.image.empty() && command.writing.coordinates == "voxel") {
    throw InputError("--coordinates voxel needs the image that the indices are of; name it after the mesh");
  }
  TerminalProgress progress(command.common.quiet);
  ImproveGivenMeshReport report;
  Improved improved = improved_mesh(command, progress, report);
  Mesh& out = improved.mesh;
  progress.step("writing " + command.out, 0.95);
  command.writing.names = command.input.names;
  from_lps(out, command.writing.coordinates, improved.frame());
  write_mesh(out, command.out, command.writing);
  if (!command.common.report_file.empty()) {
    write_text_file(command.common.report_file, json_text(report_json(command, report)) + "\n");
  }
  progress.done();
  for (const std::string& warning : report.warnings) {
    progress.line("warning: " + warning, true);
  }
  progress.line("wrote " + command.out + ": " + counts_text(out) +
                text_of(", smallest dihedral angle %.2f degrees (before %.2f)", report.after.min_dihedral_deg,
                        report.before.min_dihedral_deg));
}

}  // namespace

void add_improve_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<ImproveCommand>();
  CLI::App* improve = app.add_subcommand("improve",
                                         "the improver, and when asked the decimator, alone, on any labelled "
                                         "tet mesh, towards an image's boundaries or "
                                         "its own");
  improve->add_option("mesh", command->mesh, read_mesh_text("mesh of labelled tets"))->required();
  improve->add_option("image", command->image,
                      "label image that the mesh was made from; without it the mesh keeps its own surfaces");
  improve->add_option("-o,--out", command->out, written_mesh_text())->required();
  add_option_flag(*improve, find_option("min-dihedral"), {{"", command->defaults}}, command->settings);
  improve
      ->add_option("--max-deviation", command->max_deviation_mm,
                   "every boundary voxel, or without an image every surface vertex of the input, keeps a "
                   "surface vertex "
                   "within this distance, and facets stay within a tenth of it, mm [as the mesh has it, at "
                   "most 0.9 voxel "
                   "diagonals, or half the mean surface edge]")
      ->type_name("MM")
      ->check(number_between(1e-9, 1e9));
  improve->add_flag(
      "--decimate,!--no-decimation", command->decimate,
      "fit the surfaces to the boundary and thin the mesh out as well; without it what is below the goal is "
      "repaired and all else is left as it is");
  add_coordinates_option(*improve, command->writing.coordinates);
  add_mesh_file_options(*improve, command->writing);
  add_label_array_option(*improve, command->reading);
  add_input_options(*improve, InputScope::image, command->input);
  add_report_option(*improve, command->common, "JSON file with counts, angles and volumes before and after");
  complete_command(*improve, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d

#include "mesher/app/improve_command.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesher/app/coordinates_option.hpp"
#include "mesher/app/flag_names.hpp"
#include "mesher/app/mesh_files.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_flags.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/core/mesh_placement.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/mesh_domain.hpp"
#include "mesher/improve/improve_mesh.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/topology/labelled_tets.hpp"
#include "mesher/topology/orient_tets.hpp"

namespace cbc3d {
namespace {

// The reach of the samples, as a multiple of how far facets may be from the boundary.
constexpr double kReachPerDeviation = 10;

struct ImproveCommand {
  std::string mesh, image, out;
  MeshImageOptions defaults{.improve = {.enabled = true, .repair_rounds = 12, .untangle_rounds = 6}};
  OptionSettings settings;
  ReadMeshOptions reading;
  MeshFileOptions writing;
  double max_deviation_mm = 0;
  bool decimate = false;
  ImageInput input;
  CommonOptions common;
};

/// A mesh under improvement, and what it was before.
struct Subject {
  MaterialMesh mesh;
  LabelImage image;  ///< an empty one with the mesh's labels where none was given
  OrientReport orient;
  TetMeasures before, after;
  ImproveReport improve;
  double max_deviation_mm = 0;
  std::vector<std::string> warnings;
};

std::string text_of(const char* format, double a, double b) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// A mesh that lies elsewhere would be fitted to boundaries that are not its own.
void require_placement(const Mesh& mesh, Subject& subject) {
  const Placement placement = placement_of(mesh, subject.image);
  if (placement.elsewhere) {
    throw InputError(placement.finding);
  }
  if (!placement.finding.empty()) {
    subject.warnings.push_back(placement.finding);
  }
}

/// Null where no image was given.
const ImageFrame* frame_of(const ImproveCommand& command, const Subject& subject) {
  return command.image.empty() ? nullptr : &subject.image.frame;
}

Subject read(ImproveCommand& command) {
  Subject subject;
  if (!command.image.empty()) {
    subject.image = read_input_image(command.image, command.input);
    subject.warnings = command.input.warnings;
  }
  MeshFileOptions stated;
  Mesh mesh = read_mesh(command.mesh, command.reading, frame_of(command, subject), stated);
  require_writable_labels(labels_of(mesh), command.out);
  command.input.names.add_unknown(stated.names);
  try {
    require_improvable(mesh);
    if (command.image.empty()) {
      subject.mesh = number_labels(std::move(mesh), subject.image.labels);
    } else {
      subject.mesh = to_material_mesh(mesh, subject.image);  // labels that the image lacks are named first
      require_placement(mesh, subject);
    }
    subject.orient = orient_tets(subject.mesh);
    if (subject.mesh.tets.empty()) {
      throw InputError("all tets of the mesh have a node twice; give one with tets that have a volume");
    }
  } catch (const InputError& error) {
    throw InputError("'" + command.mesh + "': " + error.what());
  }
  return subject;
}

ImproveOptions options_of(const ImproveCommand& command) {
  MeshImageOptions options = command.defaults;
  apply_settings(command.settings, options);
  options.improve.only_bad = !command.decimate;
  options.improve.keep_distances = command.max_deviation_mm == 0;
  return options.improve;
}

void improve(const ImproveCommand& command, Subject& subject, const std::function<void(int)>& on_round) {
  ImproveOptions options = options_of(command);
  if (!command.image.empty()) {
    const double diagonal_mm = subject.image.frame.voxel_diagonal_mm();
    options.reach_mm =
        command.max_deviation_mm > 0 ? command.max_deviation_mm : tolerances::kImproveReach * diagonal_mm;
    options.deviation_diagonals = options.reach_mm / diagonal_mm / kReachPerDeviation;
    subject.max_deviation_mm = options.reach_mm;
    subject.improve = improve_mesh(subject.mesh, ImageDomain(subject.image), options, on_round);
    return;
  }
  const MeshDomain domain(subject.mesh, subject.image.labels);
  const double edge_mm = domain.scale_mm();
  if (!(edge_mm > 0)) {
    throw InputError("'" + command.mesh +
                     "': the tets' surface is a single point; give a mesh with a volume");
  }
  subject.max_deviation_mm = command.max_deviation_mm > 0 ? command.max_deviation_mm : 0.5 * edge_mm;
  options.deviation_mm = subject.max_deviation_mm / kReachPerDeviation;
  options.reach_mm = subject.max_deviation_mm;
  options.keep_distances = true;
  options.may_relabel = false;
  options.correct_volumes = false;
  subject.improve = improve_mesh(subject.mesh, domain, options, on_round);
}

void warn(const ImproveCommand& command, Subject& subject) {
  auto& warnings = subject.warnings;
  const double goal_deg = options_of(command).min_dihedral_deg;
  const auto count = [](std::size_t n) { return std::to_string(n); };
  if (subject.orient.degenerate > 0) {
    warnings.push_back(count(subject.orient.degenerate) + " tets had a node twice and were left out");
  }
  if (subject.after.not_positive > 0) {
    warnings.push_back(count(subject.after.not_positive) + " of " + count(subject.before.not_positive) +
                       " flat or inverted tets could not be untangled; they are as they were or nearly so");
  } else if (subject.after.min_dihedral_deg < goal_deg - 0.005) {
    warnings.push_back(
        text_of("the smallest dihedral angle is %.2f degrees, below the goal of %.4g; a larger "
                "--max-deviation leaves more room",
                subject.after.min_dihedral_deg, goal_deg));
  }
  for (std::size_t m = 1; command.image.empty() && m < subject.image.labels.size(); ++m) {
    const double change = 100 * (subject.after.volume_mm3[m] / subject.before.volume_mm3[m] - 1);
    if (std::fabs(change) > 1) {
      warnings.push_back(
          text_of("label %.0f changed its volume by %.2f %%; a smaller --max-deviation keeps it",
                  subject.image.labels[m], change));
    }
  }
}

nlohmann::json measures_json(const TetMeasures& m) {
  return {{"vertices", m.vertices},
          {"tets", m.tets},
          {"not_positive", m.not_positive},
          {"min_dihedral_deg", m.min_dihedral_deg},
          {"max_dihedral_deg", m.max_dihedral_deg}};
}

nlohmann::json report_json(const ImproveCommand& command, const Subject& subject, double total_s) {
  nlohmann::json stages = nlohmann::json::array();
  for (const auto& [name, seconds] : subject.improve.part_seconds) {
    stages.push_back({{"name", name}, {"seconds", seconds}});
  }
  nlohmann::json labels = nlohmann::json::array();
  for (std::size_t m = 1; m < subject.image.labels.size(); ++m) {
    labels.push_back({{"label", subject.image.labels[m]},
                      {"volume_before_mm3", subject.before.volume_mm3[m]},
                      {"volume_after_mm3", subject.after.volume_mm3[m]}});
  }
  nlohmann::json json = {
      {"status", "ok"},
      {"reason", ""},
      {"version", CBC3D_VERSION},
      {"label_names", names_json(command.input.names)},
      {"coordinates", command.writing.coordinates},
      {"options",
       {{"min_dihedral_deg", options_of(command).min_dihedral_deg},
        {"max_deviation_mm", subject.max_deviation_mm},
        {"decimation", command.decimate},
        {"image", command.image},
        {"threads", command.common.threads}}},
      {"before", measures_json(subject.before)},
      {"after", measures_json(subject.after)},
      {"labels", labels},
      {"orientation", {{"degenerate", subject.orient.degenerate}, {"turned", subject.orient.turned}}},
      {"seconds", {{"improve", total_s}, {"stages", stages}}},
      {"warnings", subject.warnings},
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
  progress.step("reading " + command.mesh, 0);
  Subject subject = read(command);
  const std::size_t materials = subject.image.labels.size();
  subject.before = measure_tets(subject.mesh, materials);
  const Stopwatch watch;
  improve(command, subject, [&](int round) {
    progress.step("improvement, round " + std::to_string(round + 1), 0.1 + 0.8 * round / (round + 5.0));
  });
  const double seconds = watch.seconds();
  subject.after = measure_tets(subject.mesh, materials);
  warn(command, subject);
  for (std::string& warning : subject.warnings) {
    warning = with_names(with_flags(warning), command.input.names);
  }
  progress.step("writing " + command.out, 0.95);
  Mesh out = to_physical_mesh(subject.mesh, subject.image);
  command.writing.names = command.input.names;
  from_lps(out, command.writing.coordinates, frame_of(command, subject));
  write_mesh(out, command.out, command.writing);
  if (!command.common.report_file.empty()) {
    write_text_file(command.common.report_file, json_text(report_json(command, subject, seconds)) + "\n");
  }
  progress.done();
  for (const std::string& warning : subject.warnings) {
    progress.line("warning: " + warning, true);
  }
  progress.line("wrote " + command.out + ": " + counts_text(out) +
                text_of(", smallest dihedral angle %.2f degrees (before %.2f)",
                        subject.after.min_dihedral_deg, subject.before.min_dihedral_deg));
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
      ->check(CLI::PositiveNumber);
  improve->add_flag(
      "--decimate,!--no-decimation", command->decimate,
      "fit the surfaces to the boundary and thin the mesh out as well; without it what is below the goal is "
      "repaired and all else is left as it is");
  add_coordinates_option(*improve, command->writing.coordinates);
  add_mesh_file_options(*improve, command->writing);
  add_label_array_option(*improve, command->reading);
  add_image_options(*improve, command->input);
  add_report_option(*improve, command->common, "JSON file with counts, angles and volumes before and after");
  complete_command(*improve, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d

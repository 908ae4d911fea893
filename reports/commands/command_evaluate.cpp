// cbc3d-bench evaluate: any mesh against any segmentation.
#include <fstream>
#include <iomanip>
#include <iostream>

#include "cases/phantoms/registry.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "metrics/evaluate.hpp"
#include "reports/commands/commands.hpp"
#include "reports/results/evaluation_text.hpp"
#include "reports/run/runner.hpp"
#include "reports/run/solve.hpp"
#include "reports/run/workplace.hpp"

namespace cbc3d::reports {
namespace {

struct EvaluateCommandOptions {
  std::string mesh, image, json;
  std::string phantom;
  std::vector<int> phantom_size;
  std::vector<double> phantom_spacing_mm;
  std::uint64_t phantom_seed = 0;
  int threads = 0;
  bool quiet = false;
  bool solve = false;
  double solve_timeout_s = RunOptions{}.timeout_s;
  metrics::EvaluateOptions metrics;
  ImageInput input{.many_labels = true};
  ReadMeshOptions mesh_reading;
};

/// What the image is, for the table of image data.
nlohmann::json image_section(const LabelImage& image) {
  const Vec3& spacing = image.frame.spacing_mm;
  return {{"size", image.frame.size},
          {"spacing_mm", {spacing.x, spacing.y, spacing.z}},
          {"labels", std::vector<Label>(image.labels.begin() + 1, image.labels.end())}};
}

/// The true shape of the labels when the image is a phantom; empty when it is none or its shape is not known.
metrics::LabelShapes shapes_of(const EvaluateCommandOptions& options) {
  if (options.phantom.empty()) {
    return {};
  }
  cases::Phantom phantom{options.phantom, {0, 0, 0}, {1, 1, 1}, options.phantom_seed, ""};
  if (const cases::PhantomKind* kind = cases::find_phantom(options.phantom)) {
    phantom.size = kind->size;
    phantom.spacing_mm = kind->spacing_mm;
  }
  if (const auto& size = options.phantom_size; !size.empty()) {
    phantom.size = {size[0], size[1], size[2]};
  }
  if (const auto& spacing_mm = options.phantom_spacing_mm; !spacing_mm.empty()) {
    phantom.spacing_mm = {spacing_mm[0], spacing_mm[1], spacing_mm[2]};
  }
  return cases::phantom_signed_distance(phantom);
}

/// Straight into the file: of tens of thousands of labels the text is hundreds of megabytes.
void write_json(const std::string& path, const nlohmann::json& evaluation) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream out(file.temporary(), std::ios::binary);
  out << std::setw(evaluation.at("quality").at("per_label").size() > 1000 ? 0 : 2) << evaluation << '\n';
  out.close();
  if (!out) {
    fail_to_write(path);
  }
  file.commit();
}

nlohmann::json solver_section(const EvaluateCommandOptions& options) {
  return solve({.command = solve_command(bin_dir()),
                .mesh = options.mesh,
                .image = options.image,
                .threads = options.threads,
                .timeout_s = options.solve_timeout_s,
                .memory_limit_bytes = RunOptions{}.memory_limit_bytes});
}

/// cbc3d-solve reads the image by itself.
void require_solvable(const EvaluateCommandOptions& options) {
  const ImageInput& input = options.input;
  const bool chosen = !input.choice.labels.empty() || !input.choice.background.empty() || input.read.volume ||
                      input.read.layer;
  if (options.solve && chosen) {
    throw InputError(
        "--solve takes images as they are; write the choice of labels, volume or layer into an image "
        "first (cbc3d clean), or leave it out");
  }
}

/// Names of labels beside them, also in the faults.
void add_label_names(nlohmann::json& evaluation, const LabelNames& names) {
  evaluation["label_names"] = names_json(names);
  if (!names.empty()) {
    evaluation["image"]["label_names"] = names_json(names);
  }
  add_names(evaluation, names);
  for (nlohmann::json& fault : evaluation.at("faults")) {
    fault = with_names(fault.get<std::string>(), names);
  }
}

int evaluate(EvaluateCommandOptions& options) {
  if (!options.json.empty()) {
    require_writable(options.json);
  }
  require_solvable(options);
  set_thread_count(options.threads);
  metrics::EvaluateOptions judged = options.metrics;
  judged.shapes = shapes_of(options);
  TerminalProgress progress(options.quiet);
  progress.step("reading", 0);
  const LabelImage image = read_input_image(options.image, options.input);
  MeshFileOptions stated;
  const Mesh mesh = read_mesh(options.mesh, options.mesh_reading, &image.frame, stated);
  LabelNames& names = options.input.names;
  names.add_unknown(stated.names);
  for (const std::string& warning : options.input.warnings) {
    progress.line("warning: " + with_names(warning, names), true);
  }
  nlohmann::json evaluation = metrics::evaluate(mesh, image, judged, progress);
  evaluation["warnings"] = options.input.warnings;
  evaluation["image"] = image_section(image);
  if (options.solve) {
    progress.step("solving", 1);
    evaluation["solver"] = solver_section(options);
  }
  constexpr double kMegabytesPerByte = 1e-6;
  evaluation["evaluation_peak_mb"] = kMegabytesPerByte * static_cast<double>(process_peak_rss_bytes());
  add_label_names(evaluation, names);
  progress.done();
  if (!options.json.empty()) {
    write_json(options.json, evaluation);
  }
  if (!options.quiet) {
    std::cout << with_names(evaluation_text(evaluation), names);
  }
  return kExitSuccess;
}

void add_phantom_options(CLI::App& parser, const std::shared_ptr<EvaluateCommandOptions>& options) {
  parser.add_option(
      "--phantom", options->phantom,
      "the image is this phantom: compare with its true shape too, where that is known; one of " +
          cases::phantom_names());
  parser
      .add_option("--phantom-size", options->phantom_size,
                  "its voxels along each axis, X,Y,Z; default: the generator's own")
      ->delimiter(',')
      ->expected(3)
      ->check(whole_number_between(1, 100000));
  parser
      .add_option("--phantom-spacing", options->phantom_spacing_mm,
                  "its voxel spacing, mm, X,Y,Z; default: the generator's own")
      ->delimiter(',')
      ->expected(3)
      ->check(number_between(1e-6, 1e6));
  parser.add_option("--phantom-seed", options->phantom_seed, "its seed")
      ->check(seed_value())
      ->capture_default_str();
}

}  // namespace

Command add_evaluate_command(CLI::App& app) {
  auto options = std::make_shared<EvaluateCommandOptions>();
  CLI::App* parser = app.add_subcommand(
      "evaluate", "Judges a mesh against a segmentation: counts, quality, fidelity, topology and faults");
  parser->add_option("MESH", options->mesh, "mesh with labelled cells: " + read_extensions())->required();
  parser->add_option("IMAGE", options->image, "label image: NIfTI, NRRD, MHA, INRIMAGE, ...")->required();
  parser->add_option("--json", options->json, "write all figures to this file");
  parser
      ->add_flag("--certified,!--no-certified", options->metrics.certified,
                 "bounds of the surface Hausdorff distances that are certain, not sampled alone")
      ->default_str("on");
  parser
      ->add_option("--tolerance", options->metrics.tolerance_mm,
                   "distance of these bounds (mm); 0: 0.02 of the smallest voxel spacing")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  parser
      ->add_flag("--smooth,!--no-smooth", options->metrics.smooth,
                 "distances to the smooth surfaces between the labels too")
      ->default_str("on");
  parser->add_flag(
      "--solve", options->solve,
      "solve Poisson's equation on the mesh with elements of order 1 and 2 (cbc3d-solve, a process of "
      "its own) and give the errors; what is not solved is null with the reason");
  parser->add_option("--solve-timeout", options->solve_timeout_s, "time limit of that process, s")
      ->check(number_between(1e-3, 1e7))
      ->capture_default_str();
  add_input_options(*parser, InputScope::reading, options->input);
  parser
      ->add_option(
          "--label-array", options->mesh_reading.label_array,
          "cell array of the mesh that has the labels (label_array): of .vtu and .vtk any [label], of .msh "
          "gmsh:physical or gmsh:geometrical [gmsh:physical]")
      ->type_name("NAME");
  add_phantom_options(*parser, options);
  add_threads_option(parser, options->threads);
  parser->add_flag("--quiet", options->quiet, "no progress and no figures on the screen");
  return {parser, [options] { return evaluate(*options); }};
}

}  // namespace cbc3d::reports

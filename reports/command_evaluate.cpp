// cbc3d-bench evaluate: any mesh against any segmentation.
#include <fstream>
#include <iomanip>
#include <iostream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/core/runtime.hpp"
#include "metrics/evaluate.hpp"
#include "reports/commands.hpp"

namespace cbc3d::reports {
namespace {

struct EvaluateCommandOptions {
  std::string mesh, image, json;
  int threads = 0;
  bool quiet = false;
  metrics::EvaluateOptions metrics;
};

/// The figures of a section that are single numbers or flags, a line each.
void print_section(const nlohmann::json& evaluation, const std::string& section) {
  std::cout << section << '\n';
  for (const auto& [key, value] : evaluation.at(section).items()) {
    if (!value.is_structured() ||
        (value.is_array() && value.size() <= 8 && !value.empty() && !value[0].is_structured())) {
      std::cout << "  " << key << ": " << value.dump() << '\n';
    }
  }
}

/// What the image is, for the table of image data.
nlohmann::json image_section(const LabelImage& image) {
  const Vec3& spacing = image.frame.spacing_mm;
  return {{"size", image.frame.size},
          {"spacing_mm", {spacing.x, spacing.y, spacing.z}},
          {"labels", std::vector<Label>(image.labels.begin() + 1, image.labels.end())}};
}

/// Straight into the file: of tens of thousands of labels the text is hundreds of megabytes.
void write_json(const std::string& path, const nlohmann::json& evaluation) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << std::setw(evaluation.at("quality").at("per_label").size() > 1000 ? 0 : 2) << evaluation << '\n';
  out.close();
  if (!out) {
    throw JobError("cannot write '" + path + "': the disk is full or the file cannot be written");
  }
  file.commit();
}

int evaluate(const EvaluateCommandOptions& options) {
  if (!options.json.empty()) {
    require_writable(options.json);
  }
  set_thread_count(options.threads);
  Progress progress(options.quiet);
  progress.step("reading", 0);
  const Mesh mesh = read_mesh(options.mesh);
  const LabelImage image = read_label_image(options.image);
  nlohmann::json evaluation = metrics::evaluate(mesh, image, options.metrics, progress);
  evaluation["image"] = image_section(image);
  progress.done();
  if (!options.json.empty()) {
    write_json(options.json, evaluation);
  }
  if (!options.quiet) {
    for (const char* section : {"counts", "quality", "fidelity", "topology"}) {
      print_section(evaluation, section);
    }
    std::cout << "faults: " << evaluation.at("faults").size() << '\n';
    for (const nlohmann::json& fault : evaluation.at("faults")) {
      std::cout << "  " << fault.get<std::string>() << '\n';
    }
  }
  return kExitSuccess;
}

}  // namespace

Command add_evaluate_command(CLI::App& app) {
  auto options = std::make_shared<EvaluateCommandOptions>();
  CLI::App* parser = app.add_subcommand(
      "evaluate", "Judges a mesh against a segmentation: counts, quality, fidelity, topology and faults");
  parser->add_option("MESH", options->mesh, "mesh with an integer cell array `label`: .vtu, .vtk or .msh")
      ->required();
  parser->add_option("IMAGE", options->image, "label image: NIfTI, NRRD, MHA, INRIMAGE, ...")->required();
  parser->add_option("--json", options->json, "write all figures to this file");
  parser
      ->add_flag("--certified,!--no-certified", options->metrics.certified,
                 "bounds of the surface Hausdorff distances that are certain, not sampled alone")
      ->default_str("on");
  parser
      ->add_option("--tolerance", options->metrics.tolerance_mm,
                   "distance of these bounds (mm); 0: 0.02 of the smallest voxel spacing")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  parser
      ->add_flag("--smooth,!--no-smooth", options->metrics.smooth,
                 "distances to the smooth surfaces between the labels too")
      ->default_str("on");
  parser->add_option("--threads", options->threads, "threads; 0: all cores")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  parser->add_flag("--quiet", options->quiet, "no progress and no figures on the screen");
  return {parser, [options] { return evaluate(*options); }};
}

}  // namespace cbc3d::reports

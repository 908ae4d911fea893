#include "mesher/pipeline/improve_given_mesh.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/core/mesh_placement.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/mesh_domain.hpp"

namespace cbc3d {
namespace {

// The reach of the samples, as a multiple of how far facets may be from the boundary.
constexpr double kReachPerDeviation = 10;

std::string text_of(const char* format, double a, double b) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// A mesh that lies elsewhere would be fitted to boundaries that are not its own.
void require_placement(const Mesh& mesh, const LabelImage& image, ImproveGivenMeshReport& report) {
  const Placement placement = placement_of(mesh, image);
  if (placement.elsewhere) {
    throw InputError(placement.finding);
  }
  if (!placement.finding.empty()) {
    report.warnings.push_back(placement.finding);
  }
}

MaterialMesh prepare(Mesh mesh, const LabelImage* image, ImproveGivenMeshReport& report) {
  require_improvable(mesh);
  MaterialMesh prepared;
  if (image == nullptr) {
    prepared = number_labels(std::move(mesh), report.labels);
  } else {
    report.labels = image->labels;
    prepared = to_material_mesh(mesh, *image);  // labels that the image lacks are named first
    require_placement(mesh, *image, report);
  }
  report.orient = orient_tets(prepared);
  if (prepared.tets.empty()) {
    throw InputError("all tets of the mesh have a node twice; give one with tets that have a volume");
  }
  return prepared;
}

ImproveOptions improve_options(const ImproveGivenMeshOptions& given) {
  ImproveOptions options = given.improve;
  options.only_bad = !given.decimate;
  options.keep_distances = given.max_deviation_mm == 0;
  return options;
}

using OnRound = std::function<void(int)>;

void improve_to_image(MaterialMesh& mesh, const LabelImage& image, const ImproveGivenMeshOptions& given,
                      const OnRound& on_round, ImproveGivenMeshReport& report) {
  ImproveOptions options = improve_options(given);
  const double diagonal_mm = image.frame.voxel_diagonal_mm();
  options.reach_mm =
      given.max_deviation_mm > 0 ? given.max_deviation_mm : tolerances::kImproveReach * diagonal_mm;
  options.deviation_diagonals = options.reach_mm / diagonal_mm / kReachPerDeviation;
  report.max_deviation_mm = options.reach_mm;
  report.improve = improve_mesh(mesh, ImageDomain(image), options, on_round);
}

void improve_to_itself(MaterialMesh& mesh, const ImproveGivenMeshOptions& given, const OnRound& on_round,
                       ImproveGivenMeshReport& report) {
  ImproveOptions options = improve_options(given);
  const MeshDomain domain(mesh, report.labels);
  const double edge_mm = domain.scale_mm();
  if (!(edge_mm > 0)) {
    throw InputError("the tets' surface is a single point; give a mesh with a volume");
  }
  report.max_deviation_mm = given.max_deviation_mm > 0 ? given.max_deviation_mm : 0.5 * edge_mm;
  options.deviation_mm = report.max_deviation_mm / kReachPerDeviation;
  options.reach_mm = report.max_deviation_mm;
  options.keep_distances = true;
  options.may_relabel = false;
  options.correct_volumes = false;
  report.improve = improve_mesh(mesh, domain, options, on_round);
}

void warn_of_volumes(ImproveGivenMeshReport& report) {
  for (std::size_t m = 1; m < report.labels.size(); ++m) {
    const double change = 100 * (report.after.volume_mm3[m] / report.before.volume_mm3[m] - 1);
    if (std::fabs(change) > 1) {
      report.warnings.push_back(
          text_of("label %.0f changed its volume by %.2f %%; a smaller max_deviation_mm keeps it",
                  report.labels[m], change));
    }
  }
}

void warn(double goal_deg, bool with_image, ImproveGivenMeshReport& report) {
  auto& warnings = report.warnings;
  const auto count = [](std::size_t n) { return std::to_string(n); };
  if (report.orient.degenerate > 0) {
    warnings.push_back(count(report.orient.degenerate) + " tets had a node twice and were left out");
  }
  if (report.after.not_positive > 0) {
    warnings.push_back(count(report.after.not_positive) + " of " + count(report.before.not_positive) +
                       " flat or inverted tets could not be untangled; they are as they were or nearly so");
  } else if (report.after.min_dihedral_deg < goal_deg - 0.005) {
    warnings.push_back(
        text_of("the smallest dihedral angle is %.2f degrees, below the goal of %.4g; a larger "
                "max_deviation_mm leaves more room",
                report.after.min_dihedral_deg, goal_deg));
  }
  if (!with_image) {
    warn_of_volumes(report);
  }
}

}  // namespace

ImproveOptions given_mesh_defaults() {
  return {.enabled = true, .repair_rounds = 12, .untangle_rounds = 6};
}

Mesh improve_given_mesh(Mesh mesh, const LabelImage* image, const ImproveGivenMeshOptions& options,
                        const Progress& progress, ImproveGivenMeshReport& report) {
  MaterialMesh improved = prepare(std::move(mesh), image, report);
  report.before = measure_tets(improved, report.labels.size());
  const Stopwatch watch;
  const OnRound on_round = [&progress](int round) {
    progress.step("improvement, round " + std::to_string(round + 1), 0.1 + 0.8 * round / (round + 5.0));
  };
  if (image != nullptr) {
    improve_to_image(improved, *image, options, on_round, report);
  } else {
    improve_to_itself(improved, options, on_round, report);
  }
  report.seconds = watch.seconds();
  report.after = measure_tets(improved, report.labels.size());
  warn(options.improve.min_dihedral_deg, image != nullptr, report);
  LabelImage own_frame;
  own_frame.labels = report.labels;
  return to_physical_mesh(improved, image != nullptr ? *image : own_frame);
}

}  // namespace cbc3d

#include "metrics/evaluate_mesh.hpp"

#include "mesher/core/json_text.hpp"
#include "metrics/evaluate.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

std::optional<double> number(const json& object, const char* key) {
  const json& value = object.at(key);
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

/// A count, 0 where the mesh cannot have one.
std::size_t count(const json& object, const char* key) {
  const json& value = object.at(key);
  return value.is_null() ? 0 : value.get<std::size_t>();
}

void take_counts(const json& counts, MeshEvaluation& result) {
  result.vertices = count(counts, "vertices");
  result.tets = count(counts, "tets");
  result.pyramids = count(counts, "pyramids");
  result.wedges = count(counts, "wedges");
  result.hexes = count(counts, "hexes");
}

void take_quality(const json& quality, MeshEvaluation& result) {
  result.inverted = count(quality, "inverted");
  result.min_dihedral_deg = number(quality, "min_dihedral_deg");
  result.max_dihedral_deg = number(quality, "max_dihedral_deg");
  result.min_scaled_jacobian = number(quality, "min_scaled_jacobian");
}

void take_fidelity(const json& fidelity, MeshEvaluation& result) {
  result.hausdorff_mm = number(fidelity, "hausdorff_mm");
  result.surface_hausdorff_mm = number(fidelity, "surface_hausdorff_mm");
  result.mean_distance_mm = number(fidelity, "mean_distance_mm");
  result.dice_min = number(fidelity, "dice_min");
  result.volume_error_percent_max = number(fidelity, "volume_error_percent_max");
  result.missing_labels = fidelity.at("missing_labels").get<std::vector<Label>>();
}

void take_topology(const json& topology, MeshEvaluation& result) {
  result.conforming = topology.at("conforming").get<bool>();
  result.components = count(topology, "components");
  result.non_manifold_edges = count(topology, "non_manifold_edges");
  result.non_manifold_vertices = count(topology, "non_manifold_vertices");
  result.self_intersections = count(topology, "self_intersections");
}

}  // namespace

MeshEvaluation evaluate_mesh(const Mesh& mesh, const LabelImage& image, const EvaluateMeshOptions& options,
                             const ProgressObserver& observer) {
  EvaluateOptions all;
  all.smooth = options.smooth;
  all.certified = options.certified;
  all.tolerance_mm = options.tolerance_mm;
  Progress progress(observer);
  const json figures = evaluate(mesh, image, all, progress);
  MeshEvaluation result;
  take_counts(figures.at("counts"), result);
  take_quality(figures.at("quality"), result);
  take_fidelity(figures.at("fidelity"), result);
  take_topology(figures.at("topology"), result);
  result.faults = figures.at("faults").get<std::vector<std::string>>();
  result.json = json_text(figures);
  return result;
}

}  // namespace cbc3d::metrics

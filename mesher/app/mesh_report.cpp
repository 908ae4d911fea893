#include "mesher/app/mesh_report.hpp"

#include "mesher/app/option_json.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

/// The options used; the lattice's spacings are those in force.
nlohmann::json used_options_json(const RunDescription& run, const MeshImageReport& report) {
  nlohmann::json options = options_json(run.options, preset_options(run.preset, run.frame),
                                        {OptionGroup::cleaning, OptionGroup::lattice, OptionGroup::mixed,
                                         OptionGroup::improvement, OptionGroup::deformation});
  options["preset"] = run.preset;
  options["threads"] = run.threads;
  options["order"] = run.order;
  options["lattice_spacing_mm"] = report.lattice_spacing_mm;
  options["finest_spacing_mm"] = report.finest_spacing_mm;
  return options;
}

nlohmann::json fidelity_json(const MeshImageReport& report) {
  nlohmann::json list = nlohmann::json::array();
  for (const MaterialFidelity& f : report.refine.fidelity) {
    list.push_back({{"label", f.label},
                    {"wanted", f.wanted},
                    {"f1", f.f1()},
                    {"f2", f.f2()},
                    {"met", f.met()},
                    {"image_voxels", f.image_voxels}});
  }
  return list;
}

nlohmann::json curve_json(const CurveReport& curve) {
  return {{"boundary_edges", curve.boundary_edges},
          {"curved_edges", curve.curved},
          {"held_back_edges", curve.held_back},
          {"straightened_edges", curve.straight},
          {"least_relative_jacobian", curve.least_jacobian}};
}

nlohmann::json topology_json(const TopologyReport& topology, const std::vector<TopologyPlace>& places) {
  nlohmann::json differences = nlohmann::json::array();
  for (const TopologyPlace& place : places) {
    differences.push_back({{"label", place.label}, {"at_mm", {place.at_mm.x, place.at_mm.y, place.at_mm.z}}});
  }
  nlohmann::json labels = nlohmann::json::array();
  for (const LabelTopology& t : topology.labels) {
    nlohmann::json extra = nlohmann::json::array();
    for (const ExtraComponent& e : t.extra) {
      extra.push_back({{"centroid_mm", {e.centroid_mm.x, e.centroid_mm.y, e.centroid_mm.z}},
                       {"volume_mm3", e.volume_mm3}});
    }
    labels.push_back({{"label", t.label},
                      {"image_regions", t.image_regions},
                      {"components", t.components},
                      {"extra_components", extra}});
  }
  return {{"non_manifold_vertices_found", topology.non_manifold_vertices},
          {"non_manifold_vertices_left", topology.non_manifold_vertices_left},
          {"tets_relabelled", topology.tets_relabelled},
          {"components_removed", topology.components_removed},
          {"difference_places", differences},
          {"labels", labels}};
}

}  // namespace

nlohmann::json mix_json(const MixReport& mix) {
  return {{"centres", mix.centres},
          {"hexes", mix.hexes},
          {"pyramids", mix.pyramids},
          {"tets_merged", mix.tets_merged},
          {"vertices_before", mix.vertices_before},
          {"vertices_after", mix.vertices_after}};
}

std::string counts_text(const Mesh& mesh) {
  std::string text =
      std::to_string(mesh.points.size()) + " vertices, " + std::to_string(mesh.tets.size()) + " tets";
  const auto add = [&text](std::size_t count, const char* kind) {
    text += count > 0 ? ", " + std::to_string(count) + " " + kind : "";
  };
  add(mesh.pyramids.size(), "pyramids");
  add(mesh.wedges.size(), "wedges");
  add(mesh.hexes.size(), "hexes");
  return text;
}

nlohmann::json counts_json(const Mesh& mesh) {
  return {{"vertices", mesh.points.size()},
          {"tets", mesh.tets.size()},
          {"pyramids", mesh.pyramids.size()},
          {"wedges", mesh.wedges.size()},
          {"hexes", mesh.hexes.size()}};
}

nlohmann::json deformation_json(const DeformReport& deform) {
  nlohmann::json iterations = nlohmann::json::array();
  for (const DeformIteration& i : deform.iterations) {
    iterations.push_back({{"matched_sources", i.matched_sources},
                          {"mean_displacement_mm", i.mean_displacement_mm},
                          {"max_displacement_mm", i.max_displacement_mm},
                          {"attempts", i.attempts},
                          {"held_vertices", i.held_vertices},
                          {"solver_iterations", i.solver.iterations},
                          {"relative_residual", i.solver.relative_residual}});
  }
  nlohmann::json parts = nlohmann::json::object();
  for (const auto& [name, seconds] : deform.part_seconds) {
    parts[name] = seconds;
  }
  return {{"seconds", parts},
          {"sources", deform.sources},
          {"targets", deform.targets},
          {"stopped_early", deform.stopped_early},
          {"iterations", iterations}};
}

nlohmann::json improvement_json(const ImproveReport& improve) {
  nlohmann::json parts = nlohmann::json::object();
  for (const auto& [name, seconds] : improve.part_seconds) {
    parts[name] = seconds;
  }
  return {{"rounds", improve.rounds},
          {"tets_before", improve.tets_before},
          {"tets_after", improve.tets_after},
          {"min_dihedral_before_deg", improve.min_dihedral_before_deg},
          {"min_dihedral_after_deg", improve.min_dihedral_after_deg},
          {"boundary_samples", improve.boundary_samples},
          {"uncovered_samples", improve.uncovered_samples},
          {"self_intersections_left", improve.self_intersections_left},
          {"surface_defects_left", improve.surface_defects_left},
          {"seconds", parts}};
}

nlohmann::json cleaning_json(const CleanReport& clean, const ImageFrame& frame) {
  const double voxel_mm3 = frame.spacing_mm.x * frame.spacing_mm.y * frame.spacing_mm.z;
  nlohmann::json labels = nlohmann::json::array();
  for (const LabelChange& change : clean.labels) {
    labels.push_back({{"label", change.label},
                      {"voxels_before", change.voxels_before},
                      {"voxels_after", change.voxels_after},
                      {"volume_change_mm3", (static_cast<double>(change.voxels_after) -
                                             static_cast<double>(change.voxels_before)) *
                                                voxel_mm3}});
  }
  return {{"holes_filled", clean.noise.holes_filled},
          {"specks_relabelled", clean.noise.specks_relabelled},
          {"regions_removed", clean.removed.regions_removed},
          {"voxels_of_regions_removed", clean.removed.voxels_removed},
          {"vertex_contacts", clean.contacts.vertex_contacts},
          {"edge_contacts", clean.contacts.edge_contacts},
          {"voxels_changed_for_contacts", clean.contacts.voxels_changed},
          {"contact_rounds", clean.contacts.rounds},
          {"contacts_joined", clean.contacts.joined},
          {"contacts_cut", clean.contacts.cut},
          {"contacts_left", clean.contacts.contacts_left},
          {"regions", clean.regions.regions},
          {"labels", labels}};
}

nlohmann::json report_json(const RunDescription& run, const MeshImageReport& report, const Mesh& mesh) {
  nlohmann::json stages = nlohmann::json::object();
  for (const auto& [name, seconds] : report.stage_seconds) {
    stages[name] = seconds;
  }
  std::vector<std::string> warnings;
  warnings.reserve(report.warnings.size());
  for (const std::string& warning : report.warnings) {
    warnings.push_back(with_names(warning, run.names));
  }
  nlohmann::json json = {
      {"status", "ok"},
      {"reason", ""},
      {"version", CBC3D_VERSION},
      {"label_names", names_json(run.names)},
      {"coordinates", run.coordinates},
      {"input", run.input},
      {"options", used_options_json(run, report)},
      {"counts", counts_json(mesh)},
      {"cleaning", cleaning_json(report.clean, run.frame)},
      {"refinement",
       {{"rounds", report.refine.rounds},
        {"finest_spacing_mm", report.finest_spacing_mm},
        {"uncovered_boundary_voxels", report.refine.uncovered_voxels}}},
      {"topology", run.options.topology.enabled ? topology_json(report.topology, report.difference_places)
                                                : nlohmann::json()},
      {"materials", fidelity_json(report)},
      {"mixed_elements", run.options.mixed ? mix_json(report.mix) : nlohmann::json()},
      {"deformation", deformation_json(report.deform)},
      {"improvement", run.options.improve.enabled ? improvement_json(report.improve) : nlohmann::json()},
      {"quadratic", run.order == 2 ? curve_json(report.curve) : nlohmann::json()},
      {"warnings", warnings},
      {"seconds",
       {{"total", report.seconds},
        {"cpu", report.cpu_seconds},
        {"system_cpu", report.system_cpu_seconds},
        {"reading", run.reading_seconds},
        {"writing", run.writing_seconds},
        {"stages", stages}}},
      {"peak_rss_bytes", process_peak_rss_bytes()}};
  add_names(json, run.names);
  return json;
}

}  // namespace cbc3d

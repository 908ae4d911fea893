#include "mesher/app/mesh_command.hpp"

#include <charconv>
#include <fstream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/stages/mesh_image.hpp"

namespace cbc3d {
namespace {

struct MeshCommand {
  std::string image;
  std::string out;
  std::string preset = "paper";
  std::vector<std::string> material_fidelity;
  std::string connectivity = "no";
  std::string target_position = "voxel-centre";
  std::string on_failure = "recover";
  std::string report_file;
  std::string dump_stages;
  int threads = 0;
  std::uint64_t seed = 1;
  bool quiet = false;
  MeshImageOptions options;
};

Connectivity connectivity_of(const std::string& name) {
  return name == "vertex" ? Connectivity::vertex
         : name == "edge" ? Connectivity::edge
         : name == "face" ? Connectivity::face
                          : Connectivity::no;
}

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// "LABEL=F" -> the map of material fidelities.
void parse_material_fidelity(const MeshCommand& command, const LabelImage& image, std::map<Label, double>& fidelity) {
  for (const std::string& text : command.material_fidelity) {
    const auto equals = text.find('=');
    Label label = 0;
    double f = 0;
    if (equals == std::string::npos || !parse_number(std::string_view(text).substr(0, equals), label) ||
        !parse_number(std::string_view(text).substr(equals + 1), f) || !(f > 0 && f <= 1)) {
      throw InputError("--material-fidelity " + text + ": give LABEL=F with F in (0, 1], for example 2=0.9");
    }
    if (std::find(image.labels.begin() + 1, image.labels.end(), label) == image.labels.end()) {
      throw InputError("--material-fidelity " + text + ": the image has no label " + std::to_string(label));
    }
    fidelity[label] = f;
  }
}

nlohmann::json options_json(const MeshCommand& c, const MeshImageReport& report) {
  const auto& o = c.options;
  nlohmann::json material = nlohmann::json::object();
  for (const auto& [label, f] : o.refine.material_fidelity) {
    material[std::to_string(label)] = f;
  }
  return {{"preset", c.preset},
          {"lattice_spacing_mm", report.lattice_spacing_mm},
          {"fidelity", o.refine.fidelity},
          {"material_fidelity", material},
          {"max_distance_mm", o.refine.max_distance_mm},
          {"iterations", o.deform.iterations},
          {"connectivity", c.connectivity},
          {"target_position", c.target_position},
          {"on_failure", c.on_failure},
          {"young_pa", o.deform.elasticity.young_pa},
          {"poisson", o.deform.elasticity.poisson},
          {"min_dihedral_deg", o.deform.min_dihedral_deg},
          {"seed", c.seed},
          {"threads", c.threads}};
}

nlohmann::json fidelity_json(const MeshImageReport& report) {
  nlohmann::json list = nlohmann::json::array();
  for (const MaterialFidelity& f : report.refine.fidelity) {
    list.push_back({{"label", f.label}, {"wanted", f.wanted}, {"f1", f.f1()}, {"f2", f.f2()}, {"met", f.met()},
                    {"image_voxels", f.image_voxels}});
  }
  return list;
}

nlohmann::json deformation_json(const MeshImageReport& report) {
  nlohmann::json iterations = nlohmann::json::array();
  for (const DeformIteration& i : report.deform.iterations) {
    iterations.push_back({{"matched_sources", i.matched_sources},
                          {"mean_displacement_mm", i.mean_displacement_mm},
                          {"max_displacement_mm", i.max_displacement_mm},
                          {"attempts", i.attempts},
                          {"recovered_vertices", i.recovered_vertices},
                          {"solver_iterations", i.solver.iterations},
                          {"relative_residual", i.solver.relative_residual}});
  }
  return {{"sources", report.deform.sources},
          {"targets", report.deform.targets},
          {"stopped_early", report.deform.stopped_early},
          {"iterations", iterations}};
}

nlohmann::json report_json(const MeshCommand& command, const MeshImageReport& report, const Mesh& mesh) {
  nlohmann::json stages = nlohmann::json::object();
  for (const auto& [name, seconds] : report.stage_seconds) {
    stages[name] = seconds;
  }
  return {{"status", "ok"},
          {"reason", ""},
          {"version", CBC3D_VERSION},
          {"options", options_json(command, report)},
          {"counts", {{"vertices", mesh.points.size()}, {"tets", mesh.tets.size()}, {"pyramids", mesh.pyramids.size()},
                      {"wedges", mesh.wedges.size()}, {"hexes", mesh.hexes.size()}}},
          {"refinement", {{"rounds", report.refine.rounds}, {"finest_spacing_mm", report.finest_spacing_mm},
                          {"uncovered_boundary_voxels", report.refine.uncovered_voxels}}},
          {"materials", fidelity_json(report)},
          {"deformation", deformation_json(report)},
          {"warnings", report.warnings},
          {"seconds", {{"total", report.seconds}, {"cpu", process_cpu_seconds()}, {"stages", stages}}},
          {"peak_rss_bytes", process_peak_rss_bytes()}};
}

void write_failure(const MeshCommand& command, const char* status, const std::string& reason) {
  if (!command.report_file.empty()) {
    const nlohmann::json json = {{"status", status}, {"reason", reason}, {"peak_rss_bytes", process_peak_rss_bytes()}};
    write_text_file(command.report_file, json.dump(2) + "\n");
  }
}

void run(MeshCommand& command) {
  command.threads = set_thread_count(command.threads);
  require_writable_mesh_path(command.out);
  if (!command.report_file.empty()) {
    require_writable(command.report_file);
  }
  Progress progress(command.quiet);
  progress.step("reading " + command.image, 0);
  const LabelImage image = read_label_image(command.image);
  auto& options = command.options;
  options.deform.connectivity = connectivity_of(command.connectivity);
  options.deform.target_position =
      command.target_position == "voxel-faces" ? TargetPosition::voxel_faces : TargetPosition::voxel_centre;
  options.deform.on_failure = command.on_failure == "stop" ? OnFailure::stop : OnFailure::recover;
  options.dump_stages = command.dump_stages;
  parse_material_fidelity(command, image, options.refine.material_fidelity);
  MeshImageReport report;
  const Mesh mesh = mesh_image(image, options, progress, report);
  if (mesh.tets.size() == 0) {
    throw JobError("the mesh of '" + command.image + "' is empty: no label is larger than the lattice; give a smaller --lattice-spacing");
  }
  progress.step("writing " + command.out, 0.97);
  write_mesh(mesh, command.out);
  if (!command.report_file.empty()) {
    write_text_file(command.report_file, report_json(command, report, mesh).dump(2) + "\n");
  }
  progress.done();
  for (const std::string& warning : report.warnings) {
    progress.line("warning: " + warning, true);
  }
  progress.line("wrote " + command.out + ": " + std::to_string(mesh.points.size()) + " vertices, " +
                std::to_string(mesh.tets.size()) + " tets");
}

void run_reporting(MeshCommand& command) {
  try {
    run(command);
  } catch (const std::bad_alloc&) {
    write_failure(command, "out_of_memory", "out of memory");
    throw;
  } catch (const JobError& error) {
    write_failure(command, "failed", error.what());
    throw;
  }
}

void add_method_options(CLI::App& mesh, MeshCommand& c) {
  auto& refine = c.options.refine;
  auto& deform = c.options.deform;
  mesh.add_option("--preset", c.preset, "paper: the published method")->check(CLI::IsMember({"paper"}))->capture_default_str();
  mesh.add_option("--lattice-spacing", c.options.lattice_spacing_mm,
                  "edge of the coarsest lattice cubes, mm (default: ten times the mean voxel spacing)")->check(CLI::PositiveNumber);
  mesh.add_option("--fidelity", refine.fidelity, "F, refine a material while F1 or F2 is below it; in (0,1]")
      ->check(CLI::Range(1e-6, 1.0))->capture_default_str();
  mesh.add_option("--material-fidelity", c.material_fidelity, "LABEL=F: fidelity of one label (repeatable)");
  mesh.add_option("--max-distance", refine.max_distance_mm,
                  "refine where a boundary voxel has no interface vertex within so many mm (default: off)")->check(CLI::NonNegativeNumber);
  mesh.add_option("--iterations", deform.iterations, "deformation iterations")->check(CLI::Range(0, 1000))->capture_default_str();
  mesh.add_option("--connectivity", c.connectivity, "pattern that thins the target points: vertex, edge, face, no")
      ->check(CLI::IsMember({"vertex", "edge", "face", "no"}))->capture_default_str();
  mesh.add_option("--target-position", c.target_position, "targets at voxel-centre (the paper's) or voxel-faces (unbiased)")
      ->check(CLI::IsMember({"voxel-centre", "voxel-faces"}))->capture_default_str();
  mesh.add_option("--on-failure", c.on_failure, "elements below the minimum quality: stop (the paper's) or recover locally and go on")
      ->check(CLI::IsMember({"stop", "recover"}))->capture_default_str();
  mesh.add_option("--young-pa", deform.elasticity.young_pa, "Young's modulus, Pa")->check(CLI::PositiveNumber)->capture_default_str();
  mesh.add_option("--poisson", deform.elasticity.poisson, "Poisson's ratio, in [0, 0.5)")->check(CLI::Range(0.0, 0.499))->capture_default_str();
  mesh.add_option("--min-dihedral", deform.min_dihedral_deg, "smallest dihedral angle kept by the deformation, degrees")
      ->check(CLI::Range(0.0, 60.0))->capture_default_str();
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* mesh = app.add_subcommand("mesh", "mesh a segmented image");
  mesh->add_option("image", command->image, "label image: NIfTI, NRRD, MHA/MHD or INRIMAGE")->required();
  mesh->add_option("--out", command->out, "mesh file: .vtu, .vtk or .msh")->required();
  add_method_options(*mesh, *command);
  mesh->add_option("--seed", command->seed, "seed of the choices made by hash")->capture_default_str();
  mesh->add_option("--report", command->report_file, "JSON file with options, counts, fidelity, seconds and warnings");
  mesh->add_option("--dump-stages", command->dump_stages, "folder for the mesh after each stage");
  mesh->add_option("--threads", command->threads, "threads of all pools (default: all cores)")->check(CLI::Range(0, 1024));
  mesh->add_flag("--quiet", command->quiet, "no progress");
  mesh->callback([command, &exit_code] {
    run_reporting(*command);
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d

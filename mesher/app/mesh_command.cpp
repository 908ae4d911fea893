#include "mesher/app/mesh_command.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/stages/mesh_image.hpp"
#include "mesher/stages/presets.hpp"

namespace cbc3d {
namespace {

/// What the command line asks to differ from the preset, in its order.
using Override = std::function<void(MeshImageOptions&)>;

struct MeshCommand {
  std::string image;
  std::string out;
  std::string preset = "quality";
  std::vector<std::string> material_fidelity;
  std::vector<Override> overrides;
  std::string report_file;
  std::string dump_stages;
  int threads = 0;
  bool quiet = false;
  MeshImageOptions options;
};

template <typename Enum>
using Names = std::vector<std::pair<const char*, Enum>>;

const Names<Connectivity> kConnectivityNames = {{"vertex", Connectivity::vertex},
                                                {"edge", Connectivity::edge},
                                                {"face", Connectivity::face},
                                                {"no", Connectivity::no}};
const Names<TargetPosition> kTargetPositionNames = {{"voxel-centre", TargetPosition::voxel_centre},
                                                    {"voxel-faces", TargetPosition::voxel_faces}};
const Names<NoisyVoxels> kNoisyVoxelNames = {
    {"none", NoisyVoxels::none}, {"holes", NoisyVoxels::holes}, {"specks", NoisyVoxels::specks}, {"both", NoisyVoxels::both}};
const Names<OnFailure> kOnFailureNames = {{"stop", OnFailure::stop}, {"recover", OnFailure::recover}};

template <typename Enum>
std::string name_of(const Names<Enum>& names, Enum value) {
  return std::find_if(names.begin(), names.end(), [value](const auto& n) { return n.second == value; })
      ->first;
}

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// "LABEL=F" -> the map of material fidelities.
void parse_material_fidelity(const MeshCommand& command, const LabelImage& image,
                             std::map<Label, double>& fidelity) {
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
          {"relabel_noise", name_of(kNoisyVoxelNames, o.clean.relabel_noise)},
          {"region_tolerance", o.clean.region_tolerance},
          {"manifold_voxels", o.clean.manifold_voxels},
          {"lattice_spacing_mm", report.lattice_spacing_mm},
          {"fidelity", o.refine.fidelity},
          {"material_fidelity", material},
          {"max_distance_mm", o.refine.max_distance_mm},
          {"finest_spacing_mm", report.finest_spacing_mm},
          {"iterations", o.deform.iterations},
          {"connectivity", name_of(kConnectivityNames, o.deform.connectivity)},
          {"target_position", name_of(kTargetPositionNames, o.deform.target_position)},
          {"on_failure", name_of(kOnFailureNames, o.deform.on_failure)},
          {"young_pa", o.deform.elasticity.young_pa},
          {"poisson", o.deform.elasticity.poisson},
          {"min_dihedral_deg", o.deform.min_dihedral_deg},
          {"seed", o.clean.seed},
          {"threads", c.threads}};
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

nlohmann::json cleaning_json(const CleanReport& clean) {
  nlohmann::json labels = nlohmann::json::array();
  for (const LabelChange& change : clean.labels) {
    labels.push_back({{"label", change.label}, {"voxels_before", change.voxels_before}, {"voxels_after", change.voxels_after}});
  }
  return {{"holes_filled", clean.noise.holes_filled},
          {"specks_relabelled", clean.noise.specks_relabelled},
          {"regions_removed", clean.removed.regions_removed},
          {"voxels_of_regions_removed", clean.removed.voxels_removed},
          {"vertex_contacts", clean.contacts.vertex_contacts},
          {"edge_contacts", clean.contacts.edge_contacts},
          {"voxels_changed_for_contacts", clean.contacts.voxels_changed},
          {"contact_rounds", clean.contacts.rounds},
          {"regions", clean.regions.regions},
          {"labels", labels}};
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
          {"counts",
           {{"vertices", mesh.points.size()},
            {"tets", mesh.tets.size()},
            {"pyramids", mesh.pyramids.size()},
            {"wedges", mesh.wedges.size()},
            {"hexes", mesh.hexes.size()}}},
          {"cleaning", cleaning_json(report.clean)},
          {"refinement",
           {{"rounds", report.refine.rounds},
            {"finest_spacing_mm", report.finest_spacing_mm},
            {"uncovered_boundary_voxels", report.refine.uncovered_voxels}}},
          {"materials", fidelity_json(report)},
          {"deformation", deformation_json(report)},
          {"warnings", report.warnings},
          {"seconds", {{"total", report.seconds}, {"cpu", process_cpu_seconds()}, {"stages", stages}}},
          {"peak_rss_bytes", process_peak_rss_bytes()}};
}

void write_failure(const MeshCommand& command, const char* status, const std::string& reason) {
  if (!command.report_file.empty()) {
    const nlohmann::json json = {
        {"status", status}, {"reason", reason}, {"peak_rss_bytes", process_peak_rss_bytes()}};
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
  LabelImage image = read_label_image(command.image);
  auto& options = command.options;
  options = preset_options(command.preset, image.frame);
  for (const Override& apply : command.overrides) {
    apply(options);
  }
  options.dump_stages = command.dump_stages;
  parse_material_fidelity(command, image, options.refine.material_fidelity);
  MeshImageReport report;
  const Mesh mesh = mesh_image(std::move(image), options, progress, report);
  if (mesh.tets.size() == 0) {
    throw JobError("the mesh of '" + command.image +
                   "' is empty: no label is larger than the lattice; give a smaller --lattice-spacing");
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

/// Adds an option whose value goes into the field that `field` picks.
template <typename Value, typename Field>
CLI::Option* add_override(CLI::App& app, MeshCommand& c, const std::string& name, const std::string& text,
                          Field field) {
  return app.add_option_function<Value>(
      name,
      [&c, field](const Value& value) {
        c.overrides.push_back([value, field](MeshImageOptions& o) { field(o) = value; });
      },
      text);
}

template <typename Enum, typename Field>
void add_choice(CLI::App& app, MeshCommand& c, const std::string& name, const std::string& text,
                const Names<Enum>& names, Field field) {
  std::vector<std::string> allowed;
  for (const auto& n : names) {
    allowed.emplace_back(n.first);
  }
  app.add_option_function<std::string>(
         name,
         [&c, &names, field](const std::string& value) {
           const Enum chosen = std::find_if(names.begin(), names.end(), [&](const auto& n) {
                                 return value == n.first;
                               })->second;
           c.overrides.push_back([chosen, field](MeshImageOptions& o) { field(o) = chosen; });
         },
         text)
      ->check(CLI::IsMember(allowed));
}

void add_cleaning_options(CLI::App& mesh, MeshCommand& c) {
  add_choice(mesh, c, "--relabel-noise", "isolated voxels given their neighbours' label: none, holes, specks or both [none]",
             kNoisyVoxelNames, [](MeshImageOptions& o) -> NoisyVoxels& { return o.clean.relabel_noise; });
  add_override<double>(mesh, c, "--region-tolerance",
                       "regions below this share of their label's voxels become background [quality: 0, paper: 1e-4]",
                       [](MeshImageOptions& o) -> double& { return o.clean.region_tolerance; })
      ->check(CLI::Range(0.0, 1.0));
  mesh.add_flag_callback(
      "--no-manifold-voxels",
      [&c] { c.overrides.emplace_back([](MeshImageOptions& o) { o.clean.manifold_voxels = false; }); },
      "leave voxels of a label that touch only by an edge or a vertex");
}

void add_lattice_options(CLI::App& mesh, MeshCommand& c) {
  add_override<double>(mesh, c, "--lattice-spacing",
                       "edge of the coarsest lattice cubes, mm [ten times the mean voxel spacing]",
                       [](MeshImageOptions& o) -> double& { return o.lattice_spacing_mm; })
      ->check(CLI::PositiveNumber);
  add_override<double>(mesh, c, "--fidelity",
                       "F: refine a material while its F1 or F2 is below; in (0,1] [0.95]",
                       [](MeshImageOptions& o) -> double& { return o.refine.fidelity; })
      ->check(CLI::Range(1e-6, 1.0));
  add_override<double>(mesh, c, "--finest-spacing",
                       "the fidelity criterion makes the lattice no finer than this, mm; --max-distance may "
                       "go to a quarter of it "
                       "[the smallest voxel spacing]",
                       [](MeshImageOptions& o) -> double& { return o.refine.finest_spacing_mm; })
      ->check(CLI::PositiveNumber);
  mesh.add_option("--material-fidelity", c.material_fidelity,
                  "LABEL=F: the fidelity of one label (repeatable)");
  add_override<double>(mesh, c, "--max-distance",
                       "refine also where a boundary voxel has no interface vertex within so many mm; 0: off "
                       "[quality: two voxel "
                       "diagonals, paper: off]",
                       [](MeshImageOptions& o) -> double& { return o.refine.max_distance_mm; })
      ->check(CLI::NonNegativeNumber);
}

void add_deformation_options(CLI::App& mesh, MeshCommand& c) {
  add_override<int>(mesh, c, "--iterations", "deformation iterations [5]", [](MeshImageOptions& o) -> int& {
    return o.deform.iterations;
  })->check(CLI::Range(0, 1000));
  add_choice(mesh, c, "--connectivity", "pattern that thins the target points: vertex, edge, face or no [no]",
             kConnectivityNames, [](MeshImageOptions& o) -> Connectivity& { return o.deform.connectivity; });
  add_choice(mesh, c, "--target-position",
             "targets at voxel-centre (half a voxel inside) or voxel-faces [quality: voxel-faces, paper: "
             "voxel-centre]",
             kTargetPositionNames,
             [](MeshImageOptions& o) -> TargetPosition& { return o.deform.target_position; });
  add_choice(mesh, c, "--on-failure",
             "where elements stay below the minimum quality: stop all, or recover there and go on [quality: "
             "recover, paper: stop]",
             kOnFailureNames, [](MeshImageOptions& o) -> OnFailure& { return o.deform.on_failure; });
  add_override<double>(mesh, c, "--young-pa", "Young's modulus, Pa [2100]",
                       [](MeshImageOptions& o) -> double& { return o.deform.elasticity.young_pa; })
      ->check(CLI::PositiveNumber);
  add_override<double>(mesh, c, "--poisson", "Poisson's ratio, in [0, 0.5) [0.45]",
                       [](MeshImageOptions& o) -> double& { return o.deform.elasticity.poisson; })
      ->check(CLI::Range(0.0, 0.499));
  add_override<double>(mesh, c, "--min-dihedral",
                       "smallest dihedral angle that the deformation keeps, degrees [5]",
                       [](MeshImageOptions& o) -> double& { return o.deform.min_dihedral_deg; })
      ->check(CLI::Range(0.0, 60.0));
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* mesh = app.add_subcommand("mesh", "mesh a segmented image");
  mesh->add_option("image", command->image, "label image: NIfTI, NRRD, MHA/MHD or INRIMAGE")->required();
  mesh->add_option("--out", command->out, "mesh file: .vtu, .vtk or .msh")->required();
  mesh->add_option("--preset", command->preset,
                   "quality: our best so far; paper: the published method [quality]")
      ->check(CLI::IsMember(preset_names()));
  add_cleaning_options(*mesh, *command);
  add_lattice_options(*mesh, *command);
  add_deformation_options(*mesh, *command);
  add_override<std::uint64_t>(*mesh, *command, "--seed", "seed of the choice among cleaning templates [1]",
                              [](MeshImageOptions& o) -> std::uint64_t& { return o.clean.seed; });
  mesh->add_option("--report", command->report_file,
                   "JSON file with options, counts, fidelity, seconds and warnings");
  mesh->add_option("--dump-stages", command->dump_stages, "folder for the mesh after each stage");
  mesh->add_option("--threads", command->threads, "threads of all pools [all cores]")
      ->check(CLI::Range(0, 1024));
  mesh->add_flag("--quiet", command->quiet, "no progress");
  mesh->callback([command, &exit_code] {
    run_reporting(*command);
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d

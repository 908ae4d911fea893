#include "baselines/cbc3d/adapter.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

constexpr const char* kSwitch = "true|false";

// What differs between the presets: the defaults as `cbc3d mesh` has them.
struct PresetDefaults {
  const char *region_tolerance, *no_manifold_voxels, *fidelity, *max_distance, *topology_checks, *iterations,
      *target_position, *pair_distance, *min_dihedral;
};

constexpr PresetDefaults kQuality{
    "0", "true (always)", "0.01", "1.06 voxel diagonals", "true (always)", "0", "voxel-faces", "0.8", "20"};
constexpr PresetDefaults kPaper{"1e-4", "false", "0.95", "0", "false", "5", "voxel-centre", "0.5", "5"};

std::vector<ParameterSpec> image_and_lattice_parameters(const PresetDefaults& preset) {
  return {
      {"relabel-noise", "none", "none|holes|specks|both", "isolated voxels given their neighbours' label"},
      {"region-tolerance", preset.region_tolerance, "",
       "regions below this share of their label become background"},
      {"no-manifold-voxels", preset.no_manifold_voxels, kSwitch,
       "leave voxels that touch only by an edge or a vertex"},
      {"seed", "1", "", "of the choice among cleaning templates"},
      {"lattice-spacing", "ten times the mean voxel spacing", "mm", "edge of the coarsest lattice cubes"},
      {"finest-spacing", "the smallest voxel spacing, but half the geometric mean at least", "mm",
       "the fidelity makes the lattice no finer"},
      {"fidelity", preset.fidelity, "", "F: refine a material while its F1 or F2 is below"},
      {"material-fidelity", "none", "LABEL=F", "the fidelity of one label"},
      {"size", "none", "LABEL=MM", "the edges of one label's elements are no longer, about"},
      {"max-distance", preset.max_distance, "mm",
       "refine where a boundary voxel has no interface vertex so near; 0: off"},
      {"topology-checks", preset.topology_checks, kSwitch,
       "make every label's sub-mesh a manifold without crumbs"},
  };
}

std::vector<ParameterSpec> deformation_parameters(const PresetDefaults& preset) {
  return {
      {"iterations", preset.iterations, "", "iterations of the deformation"},
      {"connectivity", "no", "vertex|edge|face|no", "pattern that thins the target points"},
      {"target-position", preset.target_position, "voxel-centre|voxel-faces", "where the targets lie"},
      {"on-failure", "recover", "stop|recover", "what happens where elements stay below the minimum quality"},
      {"young-pa", "2100", "Pa", "Young's modulus"},
      {"poisson", "0.45", "", "Poisson's ratio"},
      {"displacement", "normal", "normal|full", "of a source: along the surface's normal, or the full mean"},
      {"keep-outliers", "false", kSwitch, "let targets pull whose boundary looks the other way"},
      {"reach", "3", "regions", "how far a source without target in its region looks"},
      {"pair-distance", preset.pair_distance, "voxel diagonals",
       "a farther pair of source and target is pulled so near; 0: off"},
      {"attempts", "3", "", "with on-failure stop: solves with scaled displacements before it stops"},
      {"material-young", "none", "LABEL=Pa", "Young's modulus of one label"},
      {"material-poisson", "none", "LABEL=NU", "Poisson's ratio of one label"},
      {"min-scaled-jacobian", "0.2", "", "smallest scaled Jacobian of hexes and pyramids that is kept"},
  };
}

// The improvement is the default preset's; without hexes and pyramids, which it does not know.
std::vector<ParameterSpec> improvement_parameters() {
  return {
      {"no-improve", "false", kSwitch, "stop before the improvement"},
      {"decimation-rounds", "6", "",
       "rounds that thin the mesh out, as long as one takes 3 % away; 0: as many tets as before"},
      {"deviation", "0.35", "voxel diagonals", "facets stay so near to the boundary"},
      {"smoothness", "0", "", "share of the pull to the boundary that goes to smooth surfaces"},
      {"smoothness-cap", "0.2 voxel diagonals, deviation at most", "mm",
       "smoothness moves no vertex farther from the boundary"},
      {"gradation", "none", "", "growth of inner edges by the distance to the surfaces"},
  };
}

std::vector<ParameterSpec> joined(std::vector<ParameterSpec> first, const std::vector<ParameterSpec>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

std::vector<ParameterSpec> quality_parameters() {
  auto specs = joined(image_and_lattice_parameters(kQuality), deformation_parameters(kQuality));
  specs = joined(std::move(specs), improvement_parameters());
  specs.push_back(
      {"mixed", "false", kSwitch,
       "hexes in uniform regions, pyramids between them and the tets; then the paper's fidelity and "
       "iterations in place of the improvement"});
  specs.push_back(
      {"min-dihedral", kQuality.min_dihedral, "deg", "smallest dihedral angle, the improvement's goal"});
  return specs;
}

std::vector<ParameterSpec> paper_parameters(const char* mixed) {
  auto specs = joined(image_and_lattice_parameters(kPaper), deformation_parameters(kPaper));
  specs.push_back({"mixed", mixed, kSwitch, "hexes in uniform regions, pyramids between them and the tets"});
  specs.push_back(
      {"min-dihedral", kPaper.min_dihedral, "deg", "smallest dihedral angle that the deformation keeps"});
  return specs;
}

bool is_switch(const std::vector<ParameterSpec>& specs, const std::string& key) {
  return std::any_of(specs.begin(), specs.end(),
                     [&](const ParameterSpec& spec) { return spec.key == key && spec.unit == kSwitch; });
}

void append_parameter(std::vector<std::string>& argv, const std::string& mesher, bool switched,
                      const std::string& key, const std::string& value) {
  if (!switched) {
    argv.push_back("--" + key);
    argv.push_back(value);
    return;
  }
  if (value != "true" && value != "false")
    throw InputError(mesher + "." + key + "=" + value + ": a switch; give true or false");
  if (value == "true") argv.push_back("--" + key);
}

// `options`: what tells this adapter from the others, put before the job's parameters.
Adapter make(const std::string& name, const std::string& description, const std::vector<std::string>& options,
             std::vector<ParameterSpec> parameters) {
  Adapter adapter;
  adapter.name = name;
  adapter.description = description;
  adapter.licence = "Apache-2.0";
  adapter.multithreaded = true;
  adapter.openmp = true;
  adapter.parameters = std::move(parameters);
  adapter.availability = [](const std::filesystem::path& bin_dir) {
    return executable_availability(bin_dir, "cbc3d",
                                   "the program cbc3d is not built: build the target cbc3d");
  };
  adapter.command = [name, options, specs = adapter.parameters](const std::filesystem::path& bin_dir,
                                                                const MeshJob& job) {
    require_known_parameters(name, specs, job);
    std::vector<std::string> argv{(bin_dir / "cbc3d").string(),
                                  "mesh",
                                  job.image.string(),
                                  "--out",
                                  job.mesh.string(),
                                  "--report",
                                  job.report.string(),
                                  "--threads",
                                  std::to_string(job.threads),
                                  "--quiet"};
    argv.insert(argv.end(), options.begin(), options.end());
    for (const auto& [key, value] : job.parameters)
      append_parameter(argv, name, is_switch(specs, key), key, value);
    return argv;
  };
  return adapter;
}

}  // namespace

Adapter cbc3d_adapter() {
  return make("cbc3d", "CBC3D with its default preset", {}, quality_parameters());
}

Adapter cbc3d_paper_adapter() {
  return make("cbc3d-paper", "CBC3D with the paper's settings", {"--preset", "paper"},
              paper_parameters("false"));
}

Adapter cbc3d_mixed_adapter() {
  return make("cbc3d-mixed", "CBC3D with the paper's settings and mixed elements",
              {"--preset", "paper", "--mixed"}, paper_parameters("true (always)"));
}

}  // namespace cbc3d::baselines

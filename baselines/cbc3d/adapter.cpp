#include "baselines/cbc3d/adapter.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

constexpr const char* kSwitch = "true|false";

std::vector<ParameterSpec> parameters() {
  return {
      {"relabel-noise", "none", "none|holes|specks|both", "isolated voxels given their neighbours' label"},
      {"region-tolerance", "preset", "", "regions below this share of their label become background"},
      {"no-manifold-voxels", "false", kSwitch, "leave voxels that touch only by an edge or a vertex"},
      {"seed", "1", "", "of the choice among cleaning templates"},
      {"lattice-spacing", "ten voxels", "mm", "edge of the coarsest lattice cubes"},
      {"finest-spacing", "near the smallest voxel spacing", "mm", "the fidelity makes the lattice no finer"},
      {"fidelity", "0.95", "", "F: refine a material while its F1 or F2 is below"},
      {"material-fidelity", "none", "LABEL=F", "the fidelity of one label"},
      {"max-distance", "preset", "mm",
       "refine where a boundary voxel has no interface vertex so near; 0: off"},
      {"topology-checks", "false", kSwitch, "make every label's sub-mesh a manifold without crumbs"},
      {"iterations", "5", "", "iterations of the deformation"},
      {"connectivity", "no", "vertex|edge|face|no", "pattern that thins the target points"},
      {"target-position", "preset", "voxel-centre|voxel-faces", "where the targets lie"},
      {"on-failure", "preset", "stop|recover", "what happens where elements stay below the minimum quality"},
      {"young-pa", "2100", "Pa", "Young's modulus"},
      {"poisson", "0.45", "", "Poisson's ratio"},
      {"mixed", "false", kSwitch, "hexes in uniform regions, pyramids between them and the tets"},
      {"displacement", "normal", "normal|full", "of a source: along the surface's normal, or the full mean"},
      {"keep-outliers", "false", kSwitch, "let targets pull whose boundary looks the other way"},
      {"reach", "3", "regions", "how far a source without target in its region looks"},
      {"pair-distance", "preset", "voxel diagonals",
       "a farther pair of source and target is pulled so near; 0: off"},
      {"attempts", "3", "", "with on-failure stop: solves with scaled displacements before it stops"},
      {"material-young", "none", "LABEL=Pa", "Young's modulus of one label"},
      {"material-poisson", "none", "LABEL=NU", "Poisson's ratio of one label"},
      {"min-scaled-jacobian", "0.2", "", "smallest scaled Jacobian of hexes and pyramids that is kept"},
      {"min-dihedral", "5", "deg", "smallest dihedral angle that the deformation keeps"},
      {"deviation", "0.15", "voxel diagonals", "improvement: facets stay so near to the boundary"},
      {"smoothness", "0", "", "improvement: share of the pull to the boundary that goes to smooth surfaces"},
      {"smoothness-cap", "deviation", "mm", "smoothness moves no vertex farther from the boundary"},
      {"gradation", "none", "", "improvement: growth of inner edges by the distance to the surfaces"},
  };
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
Adapter make(const std::string& name, const std::string& description,
             const std::vector<std::string>& options) {
  Adapter adapter;
  adapter.name = name;
  adapter.description = description;
  adapter.licence = "Apache-2.0";
  adapter.multithreaded = true;
  adapter.parameters = parameters();
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
  return make("cbc3d", "CBC3D with its default preset", {});
}

Adapter cbc3d_paper_adapter() {
  return make("cbc3d-paper", "CBC3D with the paper's settings", {"--preset", "paper"});
}

Adapter cbc3d_mixed_adapter() {
  return make("cbc3d-mixed", "CBC3D with the paper's settings and mixed elements",
              {"--preset", "paper", "--mixed"});
}

}  // namespace cbc3d::baselines

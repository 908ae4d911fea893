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
      {"lattice-spacing", "preset", "mm", "edge of the coarsest lattice cells"},
      {"fidelity", "preset", "", "share of a boundary cell that its material must fill, F"},
      {"max-distance", "off", "mm", "largest two-sided distance allowed between mesh and image"},
      {"relabel-noise", "preset", "none|holes|specks|both", "which unconnected voxel groups are relabelled"},
      {"region-tolerance", "1e-4", "", "share of its material below which an unconnected group is noise"},
      {"iterations", "preset", "", "iterations of the deformation"},
      {"connectivity", "preset", "vertex|edge|face|no",
       "which target points a surface vertex is matched with"},
      {"young-pa", "preset", "Pa", "Young's modulus of the elastic body"},
      {"poisson", "preset", "", "Poisson's ratio of the elastic body"},
      {"min-dihedral", "preset", "deg", "dihedral angle that every element must keep"},
      {"min-scaled-jacobian", "preset", "", "scaled Jacobian that every element must keep"},
      {"seed", "preset", "", "of every pseudo-random choice"},
      {"topology-checks", "false", kSwitch, "decimate only where the topology is kept"},
      {"mixed", "false", kSwitch, "hexes and transition elements where the lattice allows"},
      {"no-manifold-voxels", "false", kSwitch, "leave non-manifold voxel contacts as they are"},
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
  const bool given = std::find(argv.begin(), argv.end(), "--" + key) != argv.end();
  if (value == "true" && !given) argv.push_back("--" + key);
  if (value == "false" && given) argv.erase(std::find(argv.begin(), argv.end(), "--" + key));
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
  Adapter adapter = make("cbc3d-mixed", "CBC3D with the paper's settings and mixed elements",
                         {"--preset", "paper", "--mixed"});
  adapter.availability = [](const std::filesystem::path&) {
    return Availability{false, "mixed elements are not built yet"};
  };
  return adapter;
}

}  // namespace cbc3d::baselines

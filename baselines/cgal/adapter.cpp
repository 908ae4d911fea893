#include "baselines/cgal/adapter.hpp"

namespace cbc3d::baselines {
namespace {

ParameterSpecs parameters() {
  return {
      {"facet-angle", "30", "deg", "smallest angle allowed in a surface facet"},
      {"facet-size", "2", "mm", "largest radius of a surface facet's Delaunay ball"},
      {"facet-distance", "2", "mm", "largest distance of a surface facet to the surface"},
      {"cell-radius-edge-ratio", "1.5", "", "largest circumradius to shortest edge ratio of a tet"},
      {"cell-size", "2.5", "mm", "largest circumradius of a tet"},
      {"label-weights", "0", "largest spacing",
       "blur of the labels' indicators that weights the domain, so that surfaces lose the voxels' steps; 0: "
       "unweighted"},
      {"odt-iterations", "0", "",
       "iterations of the optimal Delaunay triangulation energy, after refinement"},
      {"lloyd-iterations", "0", "", "iterations of Lloyd's relaxation, after those"},
      {"perturb", "true", "true|false", "move the vertices of slivers"},
      {"perturb-sliver-bound", "12", "deg", "perturbation ends at this dihedral angle"},
      {"exude", "true", "true|false", "weight vertices such that slivers leave the triangulation"},
      // CGAL's own default is 0 with a limit on the time, which does not repeat; without that limit the liver
      // takes 37 s instead of 0.2 s for the same smallest angle.
      {"exude-sliver-bound", "12", "deg",
       "exudation ends at this dihedral angle; 0: it goes as far as it can"},
      {"time-limit", "300", "s",
       "for perturbation and exudation each; 0: none. Reached, it ends repeatability"},
      {"seed", "0", "", "seed of the directions in which the first surface points are sought"},
  };
}

/// All lengths keep their ratios.
SizeDial size_dial() {
  return {.parameter = "cell-size",
          .exponent = -2.5,
          .first = 2.5,
          .lowest = 0.02,
          .highest = 1000,
          .followers = {{"facet-size", 0.8}, {"facet-distance", 0.8}}};
}

/// What baselines/tune found (README.md, tuned.csv).
std::map<std::string, std::string> tuned() {
  return {{"cell-size", "2.5"}, {"facet-distance", "0.25"}, {"facet-size", "1.5"}};
}

/// `libraries`: what the program is built with; `packages`: the Debian packages that have them.
Adapter make(const std::string& name, const std::string& description, const std::string& libraries,
             const std::string& packages) {
  const std::string executable = "cbc3d-mesher-" + name;
  Adapter adapter;
  adapter.name = name;
  adapter.description = description;
  adapter.licence = "GPL-3.0-or-later";
  adapter.parameters = ParameterSource(parameters());
  adapter.size_dial = [](const std::filesystem::path&) { return size_dial(); };
  adapter.parameter_sets["tuned"] = tuned();
  adapter.availability = [=](const std::filesystem::path& bin_dir) {
    return executable_availability(
        bin_dir, executable, "built without " + libraries + ": install " + packages + " and build again");
  };
  adapter.command = [name, executable, specs = parameters()](const std::filesystem::path& bin_dir,
                                                             const MeshJob& job) {
    return protocol_command(bin_dir / executable, name, specs, job);
  };
  return adapter;
}

}  // namespace

Adapter cgal_adapter() {
  return make("cgal", "CGAL Mesh_3, sequential, with perturbation and exudation", "CGAL", "libcgal-dev");
}

Adapter cgal_parallel_adapter() {
  Adapter adapter = make("cgal-parallel", "CGAL Mesh_3, parallel (TBB), with perturbation and exudation",
                         "CGAL or TBB", "libcgal-dev and libtbb-dev");
  adapter.deterministic = false;
  adapter.multithreaded = true;
  return adapter;
}

std::vector<Adapter> cgal_adapters() {
  return {cgal_adapter(), cgal_parallel_adapter()};
}

}  // namespace cbc3d::baselines

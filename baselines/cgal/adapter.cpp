#include "baselines/cgal/adapter.hpp"

namespace cbc3d::baselines {
namespace {

std::vector<ParameterSpec> parameters() {
  return {
      {"facet-angle", "30", "deg", "smallest angle allowed in a surface facet"},
      {"facet-size", "2", "mm", "largest radius of a surface facet's Delaunay ball"},
      {"facet-distance", "2", "mm", "largest distance of a surface facet to the surface"},
      {"cell-radius-edge-ratio", "1.5", "", "largest circumradius to shortest edge ratio of a tet"},
      {"cell-size", "2.5", "mm", "largest circumradius of a tet"},
      {"perturb", "true", "true|false", "move vertices that slivers hang on"},
      {"perturb-sliver-bound", "12", "deg", "dihedral angle at which perturbation is content"},
      {"exude", "true", "true|false", "weight vertices so that slivers leave the triangulation"},
      // CGAL leaves this at 0, bounded by a measured time: not repeatable, and without the time limit the
      // liver takes 37 s instead of 0.2 s for the same smallest angle.
      {"exude-sliver-bound", "12", "deg",
       "dihedral angle at which exudation is content; 0: as large as it gets"},
      {"time-limit", "300", "s",
       "for perturbation and exudation each; 0: none. Reached, it ends repeatability"},
      {"seed", "0", "", "of the directions in which first surface points are looked for"},
  };
}

Adapter make(const std::string& name, const std::string& executable, const std::string& description) {
  Adapter adapter;
  adapter.name = name;
  adapter.description = description;
  adapter.licence = "GPL-3.0-or-later";
  adapter.parameters = parameters();
  adapter.command = [name, executable, specs = adapter.parameters](const std::filesystem::path& bin_dir,
                                                                   const MeshJob& job) {
    return protocol_command(bin_dir / executable, name, specs, job);
  };
  return adapter;
}

}  // namespace

Adapter cgal_adapter() {
  Adapter adapter =
      make("cgal", "cbc3d-mesher-cgal", "CGAL Mesh_3, sequential, with perturbation and exudation");
  adapter.availability = [](const std::filesystem::path& bin_dir) {
    return executable_availability(bin_dir, "cbc3d-mesher-cgal",
                                   "built without CGAL: install libcgal-dev and build again");
  };
  return adapter;
}

Adapter cgal_parallel_adapter() {
  Adapter adapter = make("cgal-parallel", "cbc3d-mesher-cgal-parallel",
                         "CGAL Mesh_3, parallel (TBB), with perturbation and exudation");
  adapter.deterministic = false;
  adapter.multithreaded = true;
  adapter.availability = [](const std::filesystem::path& bin_dir) {
    return executable_availability(
        bin_dir, "cbc3d-mesher-cgal-parallel",
        "built without CGAL or TBB: install libcgal-dev and libtbb-dev and build again");
  };
  return adapter;
}

}  // namespace cbc3d::baselines

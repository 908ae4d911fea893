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

Adapter sequential() {
  return {.name = "cgal",
          .description = "CGAL Mesh_3, sequential, with perturbation and exudation",
          .licence = "GPL-3.0-or-later",
          .parameters = ParameterSource(parameters()),
          .parameter_sets = {{"tuned", tuned()}}};
}

Adapter parallel() {
  Adapter mesher = sequential();
  mesher.name = "cgal-parallel";
  mesher.description = "CGAL Mesh_3, parallel (TBB), with perturbation and exudation";
  mesher.deterministic = false;
  mesher.multithreaded = true;
  return mesher;
}

}  // namespace

std::vector<Adapter> cgal_adapters() {
  return {
      program_adapter(sequential(), size_dial(), "built without CGAL: install libcgal-dev and build again"),
      program_adapter(parallel(), size_dial(),
                      "built without CGAL or TBB: install libcgal-dev and libtbb-dev and build again")};
}

}  // namespace cbc3d::baselines

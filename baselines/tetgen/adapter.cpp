#include "baselines/tetgen/adapter.hpp"

namespace cbc3d::baselines {
namespace {

ParameterSpecs parameters() {
  return {
      {"radius-edge-ratio", "1.4", "", "largest circumradius to shortest edge ratio of a tet"},
      {"max-volume", "8", "mm^3", "largest volume of a tet"},
      {"min-dihedral", "0", "deg",
       "dihedral angle up to which tets are refined; 0: their radius alone counts"},
      {"optimization-level", "2", "", "how hard the optimization tries, from 0 to 10"},
      {"smoothing-steps", "20", "", "smoothing steps of the surface net"},
      {"reach", "0.3", "voxel",
       "largest distance of a net vertex from its place on the voxels' boundary, by axis"},
      {"repair-rounds", "10", "", "rounds in which intersecting facets are moved apart before giving up"},
  };
}

}  // namespace

Adapter tetgen_adapter() {
  Adapter adapter;
  adapter.name = "tetgen";
  adapter.description = "TetGen behind a constrained surface net of the label image";
  adapter.licence = "AGPL-3.0-or-later";
  adapter.parameters = ParameterSource(parameters());
  // The surface net is that of the voxels at any size of the tets.
  adapter.size_dial = [](const std::filesystem::path&) {
    return SizeDial{.parameter = "max-volume", .exponent = -1, .first = 8, .lowest = 1e-6, .highest = 1e6};
  };
  // What baselines/tune found (README.md, tuned.csv).
  adapter.parameter_sets["tuned"] = {{"smoothing-steps", "10"}, {"reach", "0.45"}};
  adapter.availability = [](const std::filesystem::path& bin_dir) {
    return executable_availability(bin_dir, "cbc3d-mesher-tetgen",
                                   "built without TetGen: install libtet1.5-dev and build again");
  };
  adapter.command = [specs = parameters()](const std::filesystem::path& bin_dir, const MeshJob& job) {
    return protocol_command(bin_dir / "cbc3d-mesher-tetgen", "tetgen", specs, job);
  };
  return adapter;
}

std::vector<Adapter> tetgen_adapters() {
  return {tetgen_adapter()};
}

}  // namespace cbc3d::baselines

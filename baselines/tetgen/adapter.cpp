#include "baselines/tetgen/adapter.hpp"

namespace cbc3d::baselines {
namespace {

ParameterSpecs parameters() {
  return {
      {"radius-edge-ratio", "1.4", "", "largest circumradius to shortest edge ratio of a tet"},
      {"max-volume", "8", "mm^3", "largest volume of a tet"},
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

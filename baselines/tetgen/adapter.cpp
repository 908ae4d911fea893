#include "baselines/tetgen/adapter.hpp"

namespace cbc3d::baselines {

std::vector<Adapter> tetgen_adapters() {
  const Adapter mesher{
      .name = "tetgen",
      .description = "TetGen behind a constrained surface net of the label image",
      .licence = "AGPL-3.0-or-later",
      .parameters = {{"radius-edge-ratio", "1.4", "", "largest circumradius to shortest edge ratio of a tet"},
                     {"max-volume", "8", "mm^3", "largest volume of a tet"},
                     {"min-dihedral", "0", "deg",
                      "dihedral angle up to which tets are refined; 0: their radius alone counts"},
                     {"optimization-level", "2", "", "how hard the optimization tries, from 0 to 10"},
                     {"smoothing-steps", "20", "", "smoothing steps of the surface net"},
                     {"reach", "0.3", "voxel",
                      "largest distance of a net vertex from its place on the voxels' boundary, by axis"},
                     {"repair-rounds", "10", "",
                      "rounds in which intersecting facets are moved apart before giving up"}},
      // What baselines/tune found (README.md, tuned.csv).
      .parameter_sets = {{"tuned", {{"smoothing-steps", "10"}, {"reach", "0.45"}}}},
  };
  // The surface net is that of the voxels at any size of the tets.
  return {program_adapter(
      mesher, {.parameter = "max-volume", .exponent = -1, .first = 8, .lowest = 1e-6, .highest = 1e6},
      "built without TetGen: install libtet1.5-dev and build again")};
}

}  // namespace cbc3d::baselines

#include "baselines/ld/adapter.hpp"

namespace cbc3d::baselines {

std::vector<Adapter> ld_adapters() {
  const Adapter mesher{
      .name = "ld",
      .description = "Lattice decimation with bounded angles and distances, written from its description",
      .licence = "Apache-2.0",
      .multithreaded = true,
      .openmp = true,
      // The paper's parameters, table "Input parameters for experimental evaluation".
      .parameters = {{"image-to-mesh", "0", "mm",
                      "largest distance of the image's boundary from the mesh's; 0: surfaces stay exact"},
                     {"mesh-to-image", "0", "mm",
                      "largest distance of the mesh's boundary from the image's; 0: surfaces stay exact"},
                     {"min-dihedral", "15", "deg", "smallest dihedral angle of a tet"},
                     {"max-dihedral", "180", "deg", "largest dihedral angle of a tet; 180: unbounded"},
                     {"first-min-dihedral", "30", "deg",
                      "smallest dihedral angle in a first pass over all vertices; 0: none"},
                     {"clean", "true", "true|false",
                      "join or cut voxels of a label that touch at an edge or a corner alone"},
                     {"block", "64", "voxel",
                      "side of the blocks that are meshed one by one, a power of two"}},
  };
  return {program_adapter(mesher, {.parameter = "mesh-to-image",
                                   .exponent = -1,
                                   .first = 1,
                                   .lowest = 1e-3,
                                   .highest = 1e3,
                                   .followers = {{"image-to-mesh", 1}}})};
}

}  // namespace cbc3d::baselines

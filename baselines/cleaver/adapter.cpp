#include "baselines/cleaver/adapter.hpp"

namespace cbc3d::baselines {

std::vector<Adapter> cleaver_adapters() {
  const Adapter mesher{
      .name = "cleaver",
      .description = "Lattice cleaving on a graded body-centred cubic lattice, this project's implementation",
      .licence = "Apache-2.0",
      .multithreaded = true,
      .openmp = true,
      .parameters = {{"sampling-rate", "1", "",
                      "smallest cells along the edge of a voxel, on average over its axes"},
                     {"lipschitz", "0.2", "",
                      "growth of the cells' size with the distance from the boundary"},
                     {"feature-scaling", "1", "", "factor of the cells' sizes"},
                     {"blur", "voxel", "mm",
                      "standard deviation of the Gaussian that blurs each label's mask; voxel: one voxel "
                      "along each axis"},
                     {"lattice", "graded", "graded|uniform", "cells by the sizing field, or of one size"}},
  };
  return {program_adapter(
      mesher, {.parameter = "sampling-rate", .exponent = 2.5, .first = 1, .lowest = 0.02, .highest = 8})};
}

}  // namespace cbc3d::baselines

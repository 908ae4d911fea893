#include "baselines/cleaver/adapter.hpp"

namespace cbc3d::baselines {
namespace {

ParameterSpecs parameters() {
  return {
      {"sampling-rate", "1", "", "smallest cells along the edge of a voxel, on average over its axes"},
      {"lipschitz", "0.2", "", "growth of the cells' size with the distance from the boundary"},
      {"feature-scaling", "1", "", "factor of the cells' sizes"},
      {"blur", "voxel", "mm",
       "standard deviation of the Gaussian that blurs each label's mask; voxel: one voxel along each axis"},
      {"lattice", "graded", "graded|uniform", "cells by the sizing field, or of one size"},
  };
}

}  // namespace

Adapter cleaver_adapter() {
  Adapter adapter;
  adapter.name = "cleaver";
  adapter.description =
      "Lattice cleaving on a graded body-centred cubic lattice, this project's implementation";
  adapter.licence = "Apache-2.0";
  adapter.multithreaded = true;
  adapter.openmp = true;
  adapter.parameters = ParameterSource(parameters());
  adapter.size_dial = [](const std::filesystem::path&) {
    return SizeDial{.parameter = "sampling-rate", .exponent = 2.5, .first = 1, .lowest = 0.02, .highest = 8};
  };
  adapter.availability = [](const std::filesystem::path& bin_dir) {
    return executable_availability(bin_dir, "cbc3d-mesher-cleaver",
                                   "not built: build the target cbc3d-mesher-cleaver");
  };
  adapter.command = [specs = parameters()](const std::filesystem::path& bin_dir, const MeshJob& job) {
    return protocol_command(bin_dir / "cbc3d-mesher-cleaver", "cleaver", specs, job);
  };
  return adapter;
}

std::vector<Adapter> cleaver_adapters() {
  return {cleaver_adapter()};
}

}  // namespace cbc3d::baselines

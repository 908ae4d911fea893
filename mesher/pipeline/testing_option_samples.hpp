// A good value for every option, which no preset has as its default.
#pragma once

#include <map>
#include <string>

namespace cbc3d::testing {

inline const std::map<std::string, std::string>& option_samples() {
  static const std::map<std::string, std::string> samples = {
      {"relabel-noise", "specks"},
      {"region-tolerance", "0.25"},
      {"no-manifold-voxels", "true"},
      {"seed", "7"},
      {"lattice-spacing", "6"},
      {"fidelity", "0.75"},
      {"material-fidelity", "2=0.75"},
      {"finest-spacing", "5"},
      {"max-distance", "1.25"},
      {"size", "2=3.5"},
      {"elements", "12000"},
      {"edge-length", "1.5"},
      {"topology-checks", "true"},
      {"mixed", "true"},
      {"no-improve", "true"},
      {"decimation-rounds", "2"},
      {"deviation", "0.5"},
      {"smoothness", "0.25"},
      {"smoothness-cap", "0.125"},
      {"gradation", "2"},
      {"iterations", "2"},
      {"connectivity", "edge"},
      {"target-position", "voxel-faces"},
      {"displacement", "full"},
      {"keep-outliers", "true"},
      {"reach", "2"},
      {"pair-distance", "0.75"},
      {"attempts", "1"},
      {"on-failure", "stop"},
      {"young-pa", "3000"},
      {"poisson", "0.25"},
      {"material-young", "2=6900"},
      {"material-poisson", "2=0.375"},
      {"min-dihedral", "10"},
      {"min-scaled-jacobian", "0.25"},
  };
  return samples;
}

}  // namespace cbc3d::testing

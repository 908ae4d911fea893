// The options of the mesher on the command line: each is an override of what the preset says.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

/// What the command line asks to differ from the preset; applied in its order.
using Overrides = std::vector<std::function<void(MeshImageOptions&)>>;

/// The image pre-processing: --relabel-noise, --region-tolerance, --no-manifold-voxels, --seed.
void add_cleaning_options(CLI::App& app, Overrides& overrides);
/// Lattice and refinement: --lattice-spacing, --fidelity, --max-distance, --finest-spacing,
/// --topology-checks.
void add_lattice_options(CLI::App& app, Overrides& overrides);
/// Mixed elements: --mixed.
void add_improvement_options(CLI::App& app, Overrides& overrides);
void add_mixed_options(CLI::App& app, Overrides& overrides);
/// Deformation: --iterations, --connectivity, --target-position, --displacement, --keep-outliers, --reach,
/// --attempts, --on-failure, --young-pa, --poisson, --min-dihedral, --min-scaled-jacobian.
void add_deformation_options(CLI::App& app, Overrides& overrides);

/// Values of enumerations by the names that the command line and the report use.
template <typename Enum>
using EnumNames = std::vector<std::pair<const char*, Enum>>;
extern const EnumNames<Connectivity> kConnectivityNames;
extern const EnumNames<TargetPosition> kTargetPositionNames;
extern const EnumNames<bool> kDisplacementNames;  ///< DisplacementOptions::along_normal
extern const EnumNames<NoisyVoxels> kNoisyVoxelNames;
extern const EnumNames<OnFailure> kOnFailureNames;

template <typename Enum>
std::string name_of(const EnumNames<Enum>& names, Enum value) {
  for (const auto& [name, known] : names) {
    if (known == value) {
      return name;
    }
  }
  return "";
}

}  // namespace cbc3d

// What each material's volume lacks in the end, its surface gains by a small step along its normals.
#pragma once

#include "mesher/improve/surface/covered_samples.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct BalanceOptions {
  std::vector<double> wanted_mm3;    ///< volume of every material; 0: as it comes
  std::vector<MaterialId> label_of;  ///< the first material of each one's label; a label's volume is balanced
  double tolerance = 5e-4;           ///< share of a volume that is left alone
  double step_mm = 0.05;             ///< no vertex moves farther in one round
  double goal_sine_squared = 0;      ///< no tet's worst angle falls below this, or below what it was
  int rounds = 20;                   ///< at most
};

/// Volume of every material, and the area of its surface.
struct Extent {
  std::vector<double> volume_mm3, area_mm2;
};
Extent extent_of_materials(const MaterialMesh& mesh, std::size_t materials);

/// Moves vertices between two materials; those where more meet stay. Deterministic.
void balance_volumes(MaterialMesh& mesh, const CoveredSamples& hosted, const BalanceOptions& options);

}  // namespace cbc3d

// The decimation of a mesh, or of a part of one: vertices are merged into neighbours for as long as all guards
// let them.
#pragma once

#include "baselines/ld/distance_guard.hpp"

namespace cbc3d::baselines::ld {

struct DecimationOptions {
  double min_dihedral_deg = 15;         ///< of every tet of a material
  double max_dihedral_deg = 180;        ///< likewise; 180: unbounded
  SurfaceDistanceBounds distances = {};  ///< where one of them is 0 the surfaces stay exactly as they are
  /// The smallest dihedral angle is bounded by these first, one after the other, where they are stricter.
  std::vector<double> first_min_dihedrals_deg = {30};

  [[nodiscard]] bool keeps_surfaces() const {
    return distances.image_to_mesh_mm <= 0 || distances.mesh_to_image_mm <= 0;
  }
};

/// Merges open vertices that are not frozen, and those around every merge again, until none can be merged;
/// they are not open any more then. The vertices are taken in their order, so the result is determined.
LatticeMesh decimated(LatticeMesh mesh, const CellGrid& grid, const DecimationOptions& options);

}  // namespace cbc3d::baselines::ld

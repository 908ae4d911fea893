// The decimation of a mesh, or of a part of one: vertices are merged into neighbours for as long as all
// guards let them.
#pragma once

#include "baselines/ld/distance_guard.hpp"

namespace cbc3d::baselines::ld {

struct DecimationOptions {
  double min_dihedral_deg = 15;          ///< of every tet of a material
  double max_dihedral_deg = 180;         ///< likewise; 180: unbounded
  SurfaceDistanceBounds distances = {};  ///< where one of them is 0 the surfaces stay exactly as they are
  /// The smallest dihedral angle is bounded by this first, if it is stricter.
  double first_min_dihedral_deg = 30;

  [[nodiscard]] bool keeps_surfaces() const {
    return distances.image_to_mesh_mm <= 0 || distances.mesh_to_image_mm <= 0;
  }
};

/// Merges open vertices that are not frozen, and those around every merge again, until none can be merged;
/// they are not open any more then. That is done from strict to loose: with the stricter angle, with the
/// bound of the angle, and, where surfaces may move, within the distances at last. The vertices are taken in
/// their order, so the result is determined.
LatticeMesh decimated(LatticeMesh mesh, const CellGrid& grid, const DecimationOptions& options);

}  // namespace cbc3d::baselines::ld

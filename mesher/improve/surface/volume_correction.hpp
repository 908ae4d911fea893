// The last correction of volumes: where a label's volume is too small or too large, its surface moves by a
// small step along its normals.
#pragma once

#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct VolumeCorrectionOptions {
  std::vector<double> wanted_mm3;  ///< volume of every material
  std::vector<MaterialId>
      label_of;             ///< the first material of each one's label; the volumes of labels are corrected
  double tolerance = 5e-4;  ///< an error below this share of the volume is left
  double step_mm = 0.05;    ///< no vertex moves farther in one round
  double goal_quality = 0;  ///< no tet's worst angle falls below this, or below what it was
  int rounds = 20;          ///< at most
};

/// Volume of every material, and the area of its surface.
struct Extent {
  std::vector<double> volume_mm3, area_mm2;
};
Extent extent_of_materials(const MaterialMesh& mesh, std::size_t materials);

/// Moves vertices between two materials; those where more meet stay. Covered samples stay covered.
/// Deterministic.
void correct_volumes(MaterialMesh& mesh, const SurfaceCover& cover, const VolumeCorrectionOptions& options);

}  // namespace cbc3d

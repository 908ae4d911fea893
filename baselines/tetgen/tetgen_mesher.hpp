// TetGen on a label image: a surface net of all interfaces, then constrained Delaunay tetrahedra behind it.
#pragma once

#include "baselines/core/driver.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines {

struct TetgenOptions {
  double radius_edge_ratio = 1.4;  ///< largest circumradius to shortest edge ratio of a tet
  double max_volume_mm3 = 8;       ///< largest volume of a tet
  double min_dihedral_deg = 0;     ///< up to which tets are refined; 0: their radius alone counts
  int optimization_level = 2;      ///< TetGen's -O, from 0 to 10
  int smoothing_steps = 20;        ///< of the surface net
  double reach = 0.3;              ///< of the surface net, see SurfaceNetOptions
  int repair_rounds = 10;          ///< in which intersecting facets are moved apart before giving up
};

/// Meshes `image`. The result is in physical space with the image's own labels. Throws JobError, saying what
/// TetGen met, when it fails; std::bad_alloc when it runs out of memory.
Mesh mesh_with_tetgen(const LabelImage& image, const TetgenOptions& options, StageClock& stages);

}  // namespace cbc3d::baselines

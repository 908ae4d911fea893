// CGAL Mesh_3 on a label image: Delaunay refinement with the paper's criteria, then perturbation and
// exudation.
#pragma once

#include "baselines/core/driver.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines {

struct CgalOptions {
  double facet_angle_deg = 30;           ///< smallest angle allowed in a surface facet
  double facet_size_mm = 2;              ///< largest radius of a surface facet's Delaunay ball
  double facet_distance_mm = 2;          ///< largest distance of a facet to the surface it stands for
  double cell_radius_edge_ratio = 1.5;   ///< largest circumradius to shortest edge ratio of a tet
  double cell_size_mm = 2.5;             ///< largest circumradius of a tet
  bool perturb = true;                   ///< move vertices that slivers hang on
  double perturb_sliver_bound_deg = 12;  ///< dihedral angle at which perturbation is content
  bool exude = true;                     ///< weight vertices so that slivers leave the triangulation
  double exude_sliver_bound_deg =
      12;                     ///< dihedral angle at which exudation is content; 0: as large as it gets
  double time_limit_s = 300;  ///< for perturbation and for exudation each; 0: none
  unsigned seed = 0;          ///< of the directions in which first surface points are looked for
  int threads = 1;            ///< of the parallel build; the sequential one ignores it
};

/// Meshes every labelled component of `image`. The result is in physical space with the image's own labels.
/// Throws JobError when no cell comes out.
Mesh mesh_with_cgal(const LabelImage& image, const CgalOptions& options, StageClock& stages);

}  // namespace cbc3d::baselines

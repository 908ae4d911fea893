// CGAL Mesh_3 on a label image: Delaunay refinement with the paper's criteria, then ODT and Lloyd iterations,
// perturbation and exudation, each where it is asked for.
#pragma once

#include "baselines/core/driver.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines {

struct CgalOptions {
  double facet_angle_deg = 30;          ///< smallest angle allowed in a surface facet
  double facet_size_mm = 2;             ///< largest radius of a surface facet's Delaunay ball
  double facet_distance_mm = 2;         ///< largest distance of a facet to the surface it stands for
  double cell_radius_edge_ratio = 1.5;  ///< largest circumradius to shortest edge ratio of a tet
  double cell_size_mm = 2.5;            ///< largest circumradius of a tet
  double label_weights = 0;             ///< blur of the labels' indicators in largest spacings; 0: unweighted
  int odt_iterations = 0;               ///< of the optimal Delaunay triangulation energy
  int lloyd_iterations = 0;             ///< of Lloyd's relaxation
  bool perturb = true;                  ///< move the vertices of slivers
  double perturb_sliver_bound_deg = 12;  ///< perturbation ends at this dihedral angle
  bool exude = true;                     ///< weight vertices such that slivers leave the triangulation
  double exude_sliver_bound_deg = 12;  ///< exudation ends at this dihedral angle; 0: it goes as far as it can
  double time_limit_s = 300;           ///< for perturbation and for exudation each; 0: none
  unsigned seed = 0;                   ///< of the directions in which the first surface points are sought
  int threads = 1;                     ///< of the parallel build; the sequential one ignores it
};

/// Meshes every labelled component of `image`. The result is in physical space with the image's own labels.
/// Throws JobError when no cell comes out.
Mesh mesh_with_cgal(const LabelImage& image, const CgalOptions& options, StageClock& stages);

}  // namespace cbc3d::baselines

// Delaunay refinement of a virtual box around an image, surface and volume at once, by the rules of PODM
// (Foteinos and Chrisochoides, "High quality real-time image-to-mesh conversion for finite element
// simulations", JPDC 74(2), 2014; Foteinos, Chernikov and Chrisochoides, CGTA 47, 2014).
//
// Notation: delta   sampling density of the surface, mm;
//           c, r    circumcentre and circumradius of a tet; its ball is that around c of radius r;
//           surf    the nearest place of the surface.
// Rules, of which a tet takes the first that applies:
//   R1  its ball meets the surface and no surface vertex is within delta of surf(c): insert surf(c)
//   R2  its ball meets the surface and r > 2 delta: insert c
//   R3  the dual edge of one of its facets crosses the surface at z, and the facet has an angle below 30
//       degrees or a vertex off the surface: insert z
//   R4  c is in a label and r is more than 2 times its shortest edge: insert c
//   R5  c is in a label and r is more than the size given: insert c
//   R7  c is in a label, the smallest dihedral angle is below a bound, and r is at least half of delta:
//       insert c. This rule is not in the publications; without it slivers of well below a degree stay, while
//       the published meshes have none below 4.4.
//   R6  after the insertion of a surface vertex: remove the free vertices within 2 delta of it
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/podm/label_repair.hpp"
#include "baselines/podm/surface_oracle.hpp"

namespace cbc3d::baselines::podm {

struct RefinementOptions {
  double delta_mm = 1.2;
  double radius_edge_ratio = 2;  ///< of rule 4
  double facet_angle_deg = 30;   ///< of rule 3
  double size_mm = 0;            ///< of rule 5; 0: none
  double min_dihedral_deg = 5;   ///< of rule 7; 0: none
  bool remove_free = true;       ///< rule 6
  /// The most removals for each surface vertex, on average; beyond them rule 6 rests.
  double removals_per_surface_vertex = 10;
  int threads = 1;  ///< 1 repeats itself; more do not
};

/// What the refinement did.
struct RefinementCounts {
  std::uint64_t surface_vertices = 0, free_vertices = 0, removals = 0, rollbacks = 0;
  bool removals_capped = false;
};

struct RefinementResult {
  LabelledComplex complex;  ///< all tets with the materials at their circumcentres, in local mm
  RefinementCounts counts;
  std::vector<MaterialId> sampled;  ///< materials that had no tet before their own voxels were sampled
};

/// Refines until no rule applies. Materials that have no tet then get surface vertices at the centres of
/// their voxels and of the faces of these, and a second refinement follows. The image must have a labelled
/// voxel.
RefinementResult refine(const LabelImage& image, const SurfaceOracle& oracle,
                        const RefinementOptions& options);

}  // namespace cbc3d::baselines::podm

// Where labels come within a voxel of each other, single tets are relabelled: they take the label of their
// neighbour.
//
// A tip of one label that extends into another, or across a gap, leaves a vertex on a surface where the image
// has none, and outer facets that intersect each other. Where a step of that vertex does not help, for it
// belongs to both sides, the tets of the tip become their neighbour's or background, as long as every surface
// stays a manifold, every vertex near the boundaries of its labels, and every boundary sample covered.
//
// Notation: pinch       a vertex where the surface of a label is non-manifold;
//           far vertex  a surface vertex beyond the limit (tolerances::kFarLimit) from the boundary of one of
//           its labels.
#pragma once

#include "mesher/domain/domain.hpp"
#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct RelabelOptions {
  double step_mm = 1;      ///< unit of the steps of vertices
  double largest_mm3 = 8;  ///< largest volume that is relabelled at one place
  double goal_quality =
      0;           ///< where a vertex moves, no tet's worst angle falls below this, or below what it was
  int rounds = 6;  ///< at most
  bool keep_topology = false;  ///< of the labels of tets that are relabelled (topology_guard.hpp)
};

struct RelabelReport {
  std::size_t far_vertices = 0;        ///< in the first round
  std::size_t pinches = 0;             ///< in the first round
  std::size_t self_intersections = 0;  ///< pairs of outer facets that intersect, in the first round
  std::size_t vertices_moved = 0;      ///< far vertices that a small step has brought near
  std::size_t tets_relabelled = 0;
  std::size_t defects_left =
      0;  ///< far vertices, pinches and self-intersections that the last round has found
};

/// Relabels tets of `mesh`; those that become background are taken out. Vertices keep their numbers. `cover`
/// follows. Deterministic.
RelabelReport relabel_misplaced_tets(MaterialMesh& mesh, SurfaceCover& cover, const Domain& domain,
                                     const RelabelOptions& options);

}  // namespace cbc3d

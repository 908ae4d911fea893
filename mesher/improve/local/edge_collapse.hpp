// Collapse of edges: a vertex moves onto a neighbour, or both move to a place between, and the tets at their
// edge vanish. Decimation by guarded collapses follows Chernikov and Chrisochoides (Multitissue tetrahedral
// image-to-mesh conversion with guaranteed quality and fidelity, SIAM J. Sci. Comput. 33, 2011): no collapse
// may break a bound of angle or of distance.
#pragma once

#include <limits>

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

struct CollapseOptions {
  double threshold_quality = 0.1;  ///< new tets are no worse than this
  double longest_growth = 2.5;     ///< longest new edge, in multiples of the mean old one
  const std::vector<double>* longest_mm =
      nullptr;  ///< longest new edge in tets of each material; null: no limit
  double longest_on_surface_mm = std::numeric_limits<double>::infinity();  ///< at vertices on interfaces
  std::size_t largest_valence = 26;  ///< edges at the vertex that is left, unless one of the two had more
  bool only_bad =
      false;            ///< only vertices of tets below the threshold, where a collapse lifts the worst angle
  bool graded = false;  ///< where inner vertices vanish, new edges keep to Patch::longest_mm
  bool optimize_position =
      false;                   ///< where no neighbour's place will do, one between the two is searched for
  std::size_t least_tets = 0;  ///< the pass ends when the patch has no more tets than this
  double volume_share = 1;     ///< largest loss of a material, as a share of its volume around the vertex
};

/// One pass over all vertices in order: each collapses onto the neighbour that leaves the best worst angle,
/// if every guard allows it. A vertex on an interface moves along the interface, one where three materials
/// meet along that curve. Boundary samples stay covered, facets stay near the boundary and do not fold, and
/// every label's surface stays a manifold of the same topology.
///
/// With `optimize_position` a vertex for which no neighbour's place will do is tried with each neighbour of
/// the same materials, the nearest first: inside a material half way, on interfaces at a place near that or
/// near either end, on the boundary and within the reach of all samples of the two that no vertex around
/// covers. Returns the number of vertices removed.
std::size_t collapse_edges(Patch& patch, const CollapseOptions& options);

}  // namespace cbc3d

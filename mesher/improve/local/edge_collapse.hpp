// Collapse of edges: a vertex is drawn onto a neighbour, or both to a place between, and what lies between
// them vanishes.
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

struct CollapseOptions {
  double threshold_sine_squared = 0.1;  ///< new tets are no worse than this
  double longest_growth = 2.5;          ///< new edges are no longer than so many times the mean old one
  const std::vector<double>* longest_mm =
      nullptr;                     ///< nor, in tets of material m, than (*longest_mm)[m]; null: no limit
  bool only_bad = false;           ///< only vertices of tets below the threshold, where that lifts the worst
  bool graded = false;             ///< where inner vertices vanish new edges keep to Patch::longest_mm
  bool optimize_position = false;  ///< where no neighbour's place will do, one between the two is looked for
  double volume_share = 1;         ///< of what a material has round a vertex of its surface, lost at most
};

/// One pass over all vertices in order: each is drawn onto the neighbour that leaves the best worst angle,
/// if every guard allows one. A vertex on an interface is drawn along it, one where three materials meet
/// along that curve; boundary voxels keep hosts, facets stay near the boundary and do not fold, every label's
/// surface stays a manifold of the same shape.
///
/// With `optimize_position` a vertex for which no neighbour's place will do is tried with each neighbour of
/// the same materials, the nearest first: inside a material half way, on interfaces at a place near that or
/// near either end which is on the boundary and within reach of all points of the two that no vertex around
/// reaches. Returns the number of vertices removed.
std::size_t collapse_edges(Patch& patch, const CollapseOptions& options);

}  // namespace cbc3d

// Local search for the removal of surface defects, place by place: the last stage of the improvement.
//
// Around each defect two rings of vertices are searched for a change that makes the surfaces there better and
// nothing worse (SurfaceDefects): steps of vertices, groups of tets that are relabelled at once, and both
// together. Defects are counted after a change as a whole, so that on the way there a surface may be
// non-manifold. The goal of the angles holds throughout.
#pragma once

#include <span>

#include "mesher/improve/surface/surface_defects.hpp"

namespace cbc3d {

struct DefectRemovalOptions {
  double limit_mm = 1;              ///< of distances between surfaces and boundaries, both ways
  double step_mm = 1;               ///< unit of the steps of vertices
  double largest_mm3 = 8;           ///< largest volume that is relabelled at once
  double goal_quality = 0;          ///< no tet's worst angle falls below this, or below what it was
  int rounds = 4;                   ///< at most
  bool keep_topology = false;       ///< of the labels of tets that are relabelled (topology_guard.hpp)
  std::size_t most_trials = 0;      ///< trial edits in all; 0: 10,000 and one for every eight tets
  std::size_t place_trials = 8000;  ///< trial edits at one place
  std::span<const std::uint8_t> fixed = {};  ///< inner vertices, nonzero: make no room; empty: none is fixed
};

struct DefectRemovalReport {
  std::size_t defects = 0;  ///< before; one may count several times
  std::size_t defects_left = 0;
  std::size_t self_intersections_left = 0;  ///< pairs of facets
  std::size_t folds = 0;                    ///< pairs of facets, before
  std::size_t folds_left = 0;
  std::size_t tets_relabelled = 0;
  std::size_t vertices_moved = 0;
};

/// Removes the defects for which the search finds a change. Does nothing where the trials would not suffice
/// for a look at every defect. Tets that become background are taken out; vertices keep their numbers.
/// Deterministic.
DefectRemovalReport remove_surface_defects(MaterialMesh& mesh, const Domain& domain,
                                           const DefectRemovalOptions& options);

}  // namespace cbc3d

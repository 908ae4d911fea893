// The end game of the improvement: what is still wrong with the surfaces, place by place.
//
// Round each fault two rings of vertices are searched for a change that makes the surfaces there better and
// nothing worse (SurfaceDefects): steps of vertices, groups of tets that change hands at once, and both
// together. Faults are counted after a change as a whole, so that on the way there a surface may be no
// manifold. The goal of the angles holds throughout.
#pragma once

#include "mesher/improve/surface/surface_defects.hpp"

namespace cbc3d {

struct MendOptions {
  double limit_mm = 1;              ///< of distances between surfaces and boundary voxels, both ways
  double step_mm = 1;               ///< unit of the steps of vertices
  double largest_mm3 = 8;           ///< no more than this changes hands at once
  double goal_sine_squared = 0;     ///< no tet's worst angle falls below this, or below what it was
  int rounds = 4;                   ///< at most
  std::size_t most_trials = 0;      ///< of changes, in all; 0: 10,000 and one for every eight tets
  std::size_t place_trials = 8000;  ///< of changes, at one place
};

struct MendReport {
  std::size_t faults = 0;  ///< before; one may count several times
  std::size_t faults_left = 0;
  std::size_t cuts_left = 0;  ///< pairs of facets
  std::size_t folds = 0;      ///< likewise, before
  std::size_t folds_left = 0;
  std::size_t tets_relabelled = 0;
  std::size_t vertices_moved = 0;
};

/// Mends what it can, but nothing where the trials would not do for a look at every fault; tets that become
/// background are taken out. Vertices keep their numbers. Deterministic.
MendReport mend_surfaces(MaterialMesh& mesh, const std::vector<InterfacePoint>& points,
                         const ImagePlaces& places, const MendOptions& options);

}  // namespace cbc3d

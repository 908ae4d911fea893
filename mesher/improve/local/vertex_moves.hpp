// Moves of single vertices: towards well-shaped tets and the boundary, and out of the worst angle.
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

struct RelaxOptions {
  double surface_weight = 30;  ///< pull to the boundary against the tets' shape
  double max_step = 0.5;       ///< of the mean distance to the neighbours
  double skip_below_mm = 0;    ///< a step shorter than this is not taken
  /// In [0,1]: the share of the pull to the boundary that goes to smoothness instead, see below.
  double smoothness = 0;
  double smoothness_cap_mm = 0;  ///< smoothness takes no vertex farther from its boundary than this
};

/// One sweep over all vertices in order (Gauss-Seidel): each takes a Newton step that lowers
///   sum over its tets of (inverse mean ratio)^3 + weight / 2 * sum over its boundaries of (distance / h)^2,
/// h the mean distance to its neighbours, halved until the energy falls, no tet turns over and every boundary
/// voxel keeps its host. Returns the number of vertices moved.
///
/// With a smoothness S the weight of the distances is (1 - S) of what it was, and vertices on one interface
/// alone have in addition
///   S weight / 2 * mean over their neighbours w on the same interface of ((x - w) . m_w / h)^2,
/// m_w the mean of the two vertices' normals, each the mean of its facets'. That is zero on spheres and
/// nearly so on all surfaces whose curvature changes little from edge to edge: wrinkles go, bends stay.
std::size_t relax_vertices(Patch& patch, const RelaxOptions& options);

/// Relaxes the vertices that are farther from their boundaries than the patch's guard allows, and their
/// neighbours, a few times each. Returns the number of moves.
std::size_t project_far_vertices(Patch& patch, const RelaxOptions& options);

/// Moves the vertices of tets whose worst angle is below the goal, wherever that lifts the worst angle of the
/// vertex's star. Returns the number of vertices moved.
std::size_t climb_vertices(Patch& patch, double goal_sine_squared);

}  // namespace cbc3d

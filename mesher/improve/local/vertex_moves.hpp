// Moves of single vertices: towards well-shaped tets and the boundary, and away from the worst angle.
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

struct RelaxOptions {
  double surface_weight = 30;  ///< weight of the distances from the boundary against the tets' shape
  double max_step = 0.5;       ///< longest step, as a share of the mean distance to the neighbours
  double skip_below_mm = 0;    ///< a step shorter than this is not taken
  /// In [0,1]: the share of the weight that goes to the smoothness of the surface instead, see below.
  double smoothness = 0;
  double smoothness_cap_mm = 0;  ///< the smoothness moves no vertex farther from its boundary than this
};

/// One sweep over all vertices in order (Gauss-Seidel): each takes a Newton step that lowers
///   sum over its tets of (inverse mean ratio)^3 + weight / 2 * sum over its boundaries of (distance / h)^2,
/// h the scale of the domain. The step is halved until the energy falls, no tet turns over and every boundary
/// sample stays covered. Returns the number of vertices moved.
///
/// With a smoothness S the weight of the distances is (1 - S) of what it was, and vertices on a single
/// interface have the additional term
///   S weight / 2 * mean over their neighbours w on the same interface of ((x - w) . m_w / h)^2,
/// where m_w is the mean of the two vertices' normals, each of which is the mean of its facets' normals. The
/// term is zero on spheres and nearly zero on all surfaces whose curvature changes little from edge to edge:
/// it removes wrinkles and leaves bends.
std::size_t relax_vertices(Patch& patch, const RelaxOptions& options);

/// Relaxes the vertices that are farther from their boundaries than the patch's guard allows, and their
/// neighbours, a few times each. Returns the number of moves.
std::size_t project_far_vertices(Patch& patch, const RelaxOptions& options);

/// Optimisation-based smoothing (Freitag and Ollivier-Gooch 1997): moves the vertices of tets whose worst
/// angle is below the goal, wherever that lifts the worst angle of the vertex's star. A search by steps along
/// the steepest ascent and the axes takes the place of their linear programme. Returns the number of vertices
/// moved.
std::size_t optimize_worst_angles(Patch& patch, double goal_quality);

}  // namespace cbc3d

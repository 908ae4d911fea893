// The first warp: vertices move onto cuts that are too near to them (Bronson, Levine and Whitaker 2014,
// section 3).
#pragma once

#include "baselines/cleaver/cut_lattice.hpp"

namespace cbc3d::baselines::cleaver {

/// Angles of the background's tets beyond which no vertex is moved: those of the proof.
inline constexpr double kLeastAngleDeg = 2.76;
inline constexpr double kMostAngleDeg = 175.42;

/// Moves each vertex with violating cuts to their mean, and snaps to it all its cuts between the same two
/// materials. Then finds the other cuts of moved vertices again on their new edges. Two vertices of an edge
/// never claim one cut, so the order, that of the vertices' numbers, matters only where snapping takes a cut
/// from a neighbour. Where a tet would have worse angles than those above, its vertices go only part of their
/// way.
void warp_vertices(CutLattice& cut, const Indicators& indicators);

}  // namespace cbc3d::baselines::cleaver

// The places on faces where three materials meet, and the second warp: those too near to an edge snap to its
// cut (Bronson, Levine and Whitaker 2014, section 3).
#pragma once

#include "baselines/cleaver/cut_lattice.hpp"

namespace cbc3d::baselines::cleaver {

/// Finds the triple of each face of three materials with at least two cuts within its edges; on other faces
/// it is at a vertex or at the only cut. Call it when the vertices have been warped.
void find_triples(CutLattice& cut, const Indicators& indicators);

}  // namespace cbc3d::baselines::cleaver

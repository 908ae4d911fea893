// How near to a vertex a cut may be before the vertex is moved onto it.
#pragma once

#include "baselines/cleaver/cut_lattice.hpp"

namespace cbc3d::baselines::cleaver {

/// The fractions of the uniform lattice's edges for which the angles are proven (Bronson, Levine and Whitaker
/// 2014): of edges along the axes, and of those between corners and centres.
inline constexpr double kLongAlpha = 0.203;
inline constexpr double kShortAlpha = 0.357;

/// Sets the alphas of all cuts. At vertices all of whose tets are body-centred cubic ones of one size they
/// are the two above. At others no vertex may move farther than a fraction of the least height of its tets
/// and of the least distance between opposite edges, so that no tet can turn inside out whichever way its
/// vertices move.
void set_alphas(CutLattice& cut);

}  // namespace cbc3d::baselines::cleaver

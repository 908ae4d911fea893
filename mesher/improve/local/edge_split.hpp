// New vertices on edges inside a material, where nothing else lifts a bad tet.
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

/// For every tet whose worst angle is below the goal: splits the edge of it, inside one material, whose new
/// vertex finds the place with the best worst angle of all tets round it, if that is better than those at the
/// edge had. Cures the flat tets with all vertices on one interface, which no move, flip or collapse reaches.
/// Returns the number of edges split.
std::size_t split_edges(Patch& patch, double goal_sine_squared);

}  // namespace cbc3d

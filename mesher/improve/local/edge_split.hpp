// New vertices on edges inside a material, where no other operation lifts a bad tet.
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

/// For every tet whose worst angle is below the goal: of its edges inside one material, splits the one whose
/// new vertex finds the best place, by the worst angle of all tets around it, if that angle is better than
/// the worst at the edge was (Klingner and Shewchuk, Int. Meshing Roundtable 2007, insert vertices likewise).
/// This cures flat tets with all vertices on one interface, which no move, flip or collapse reaches. Returns
/// the number of edges split.
std::size_t split_edges(Patch& patch, double goal_quality);

}  // namespace cbc3d

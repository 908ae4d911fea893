// Removal of edges: the tets around an edge are replaced by others without it (Freitag and Ollivier-Gooch,
// Int. J. Numer. Meth. Engng 40, 1997).
//
// Notation: polygon  the ring of the edge a, b. Triangulating it and joining each triangle to a and to b
// gives the new
//                    tets; dynamic programming finds the triangulation whose worst tet is best (Klincsek,
//                    Annals of Discrete Mathematics 9, 1980).
#pragma once

#include "mesher/improve/local/patch.hpp"

namespace cbc3d {

/// Tries the edges of every tet whose worst angle is below the goal, and removes an edge where that lifts the
/// worst angle of the tets around it. An edge on one interface is flipped to the other diagonal of its two
/// facets, with the guards of the patch; edges where more than two materials meet stay. Returns the number of
/// edges removed.
std::size_t remove_edges(Patch& patch, double goal_quality);

/// Flips edges of interfaces where that makes the interface flatter, if no new tet has a worse angle than the
/// floor or than the worst one before. Returns the number of edges flipped.
std::size_t flatten_interfaces(Patch& patch, double floor_quality);

}  // namespace cbc3d

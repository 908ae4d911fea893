// Tets from anywhere made fit to be changed: of one orientation along every shared face.
#pragma once

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct OrientReport {
  std::size_t degenerate = 0;    ///< tets that had a vertex twice, left out
  std::size_t turned = 0;        ///< tets whose node order was mirrored
  std::size_t not_positive = 0;  ///< tets that lie inside out among their neighbours, or flat
};

/// Leaves out tets with a repeated vertex and gives all tets that are connected through faces one
/// orientation, the one with a positive sum of volumes. A tet that is not positive then is tangled, not
/// misnumbered. Throws InputError where a face belongs to more than two tets.
OrientReport orient_tets(MaterialMesh& mesh);

/// Tets without positive volume.
std::size_t count_not_positive(const MaterialMesh& mesh);

}  // namespace cbc3d

// A labelled tet mesh from a file, of whatever origin, as the improver takes it; and what it measures.
#pragma once

#include <vector>

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// Refuses what the improver cannot take: other cells than tets, none at all, nodes that are not there,
/// coordinates that are no numbers, more labels than there are materials. Throws InputError, one line with
/// the remedy.
void require_improvable(const Mesh& mesh);

/// The mesh with its labels, 0 too, numbered as materials from 1 on; `labels[m]` is the value of material m.
MaterialMesh number_labels(Mesh mesh, std::vector<Label>& labels);

struct TetMeasures {
  std::size_t vertices = 0, tets = 0;
  std::size_t not_positive = 0;                       ///< flat or inside out
  double min_dihedral_deg = 0, max_dihedral_deg = 0;  ///< 0 and 180 where a tet is not positive
  std::vector<double> volume_mm3;                     ///< of every material
};
TetMeasures measure_tets(const MaterialMesh& mesh, std::size_t materials);

}  // namespace cbc3d

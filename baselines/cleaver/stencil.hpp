// The output tets of the cut lattice: the generalised stencil of flags (Bronson, Levine and Whitaker 2014,
// section 3), with its virtual cuts, triples and quads chosen after snapping.
//
// Every lattice tet is cut into flags (corner, cut of an edge, triple of a face, quad), each of the material
// of its corner; those with a point twice vanish. An edge without a cut within has it at an end, a face
// without a triple within has it at a cut or a corner, and the rules for these look at the edge or face
// alone, so that the two tets of a face agree. The quad is within its tet, so it may be wherever the tet's
// angles are best: at any corner, cut or triple from which no flag is flat, or at a place inside.
#pragma once

#include "baselines/cleaver/cut_lattice.hpp"

namespace cbc3d::baselines::cleaver {

/// Tets with the material of each.
struct CleavedMesh {
  std::vector<Vec3> points;  ///< local mm
  TetNodes tets;             ///< positive
  std::vector<MaterialId> materials;
};

/// The pieces of all tets of the lattice; those of background only where `keeps_background`.
CleavedMesh cleave_tets(const CutLattice& cut, const Indicators& indicators, bool keeps_background = false);

}  // namespace cbc3d::baselines::cleaver

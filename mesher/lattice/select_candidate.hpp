// Stage "Candidate mesh selection" (paper, section "Adaptive Lattice Refinement"): relabels tets so that the
// surfaces are fit for deformation.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// Relabels tets until
///   - no labelled tet has more than one face towards background (the outside of the lattice counts as
///   background);
///   - no tet would lose interface faces by taking over the material of most of its neighbours.
/// Ties between two labelled materials go to the one with fewer tets (so that thin structures survive),
/// whatever their numbers; ties with background go to background, as the paper's rule asks. Every step either
/// removes interface faces or moves a tet to the preferred side of a tie, so the sweeps end. `rank[m]`:
/// preference of material m in ties, higher wins; rank_by_size with background highest. Returns how many tets
/// were relabelled.
std::size_t select_candidate(const TetNeighbours& neighbours, const std::vector<std::uint32_t>& rank,
                             std::vector<MaterialId>& materials);

}  // namespace cbc3d

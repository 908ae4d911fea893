// Red-green subdivision of the lattice (paper, figure "Red-Green templates for lattice subdivision").
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/stages/lattice.hpp"

namespace cbc3d {

/// Splits the marked red tets 1:8 (inner diagonal: the shortest, so that the children are congruent to the
/// parent) and then every red tet that the green templates cannot close, until the whole is conforming:
///   no edge split: stays;  one edge: 1:2;  two opposite edges: 1:4;  the three edges of a face: 1:4;
///   two edges of one face: the third edge of that face is split too;  all else: red.
/// `marked` has one entry per red tet; tets at the deepest level are never split, marked or not: the closure
/// never needs that, because a neighbour can be at most as deep. Returns the number of red tets that were
/// split.
std::size_t refine_red_green(Lattice& lattice, const std::vector<std::uint8_t>& marked);

/// How many tets of the conforming mesh a red tet is: itself, or 2 or 4 green pieces.
std::uint32_t piece_count(const RedTet& red);

/// Writes the tets of red tet `red` to their places in `tets`, from `first` on.
void write_pieces(const Lattice& lattice, std::size_t red, std::size_t first, LatticeTets& tets);

/// The conforming mesh of the lattice as it stands: red leaves and green pieces, in the order of the red
/// tets.
LatticeTets extract_tets(const Lattice& lattice);

}  // namespace cbc3d

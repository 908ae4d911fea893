// One lattice tet in pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baselines/cleaver/cut_lattice.hpp"

namespace cbc3d::baselines::cleaver {

/// The points of a tet that is cut: corners 0..3, the cut of edge e at 4 + e, the triple of face f at 10 + f,
/// the quad at 14.
inline constexpr std::uint8_t kQuad = 14;

struct TetPiece {
  std::array<std::uint8_t, 4> points;
  std::uint8_t corner;  ///< whose material the piece has, if it lies along an edge that is cut
  std::uint8_t edge;    ///< along which it lies, at that corner
};

/// A tet with its cuts and triples where they have come to be.
struct TetState {
  std::array<VertexId, 4> nodes{};          ///< for an order that neighbours agree on
  std::array<std::uint8_t, 6> cut_at{};     ///< the point at which each edge's cut is: 4 + e, or a corner
  std::array<std::uint8_t, 4> triple_at{};  ///< the point at which each face's triple is
  std::array<Vec3, 15> places{};            ///< of the points that are in use
};

/// The state of a mixed tet.
TetState state_of(const CutLattice& cut, const MixedTet& mixed);

/// The pieces, all positive. They are at most 24.
struct TetPieces {
  std::array<TetPiece, 24> pieces;
  std::size_t count = 0;
  bool uses_quad = false;
  Vec3 quad_place;  ///< where it is used
};
TetPieces pieces_of(const TetState& given);

}  // namespace cbc3d::baselines::cleaver

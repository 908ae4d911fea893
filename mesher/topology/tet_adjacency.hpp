// Which tets share a face.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/core/uninitialized_vector.hpp"

namespace cbc3d {

using TetId = std::uint32_t;
inline constexpr TetId kNoTet = 0xFFFFFFFFU;
inline constexpr TetId kUnknownTet = 0xFFFFFFFEU;  ///< find_unknown_neighbours is to find it

/// Across the face opposite to each node of each tet.
using TetNeighbours = UninitializedVector<std::array<TetId, 4>>;

/// For each tet and node n: the tet across the face opposite to node n, kNoTet on the outside.
/// Linear in the tets, parallel. Throws JobError when a face has more than two tets (the mesh is not
/// conforming).
TetNeighbours tet_neighbours(const TetNodes& tets, std::size_t vertex_count);

/// The same for the faces that `neighbours` has as kUnknownTet, from both their sides; the others stay.
void find_unknown_neighbours(const TetNodes& tets, std::size_t vertex_count, TetNeighbours& neighbours);

/// The nodes of the face opposite to node n, counter-clockwise seen from outside a positive tet.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kTetFace = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A cell of a mesh; a tet's number as a cell is its TetId (see MaterialMesh).
using CellId = std::uint32_t;

/// The cells around each vertex in compressed rows: those of v are cells[first[v]] ... cells[first[v + 1] -
/// 1], ascending.
struct VertexCells {
  std::vector<std::uint32_t> first;
  std::vector<CellId> cells;

  /// The star of a vertex.
  [[nodiscard]] std::span<const CellId> of(VertexId v) const {
    return {cells.data() + first[v], cells.data() + first[v + 1]};
  }
};
/// The tets around each vertex of a mesh of tets alone. Parallel.
VertexCells tets_of_vertices(const TetNodes& tets, std::size_t vertex_count);

}  // namespace cbc3d

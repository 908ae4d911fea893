// A mesh of lattice points, whole or a part of a larger one, and what its vertices carry for the decimation.
#pragma once

#include <vector>

#include "baselines/ld/cell_grid.hpp"
#include "baselines/ld/strata.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines::ld {

/// What a vertex is, in a byte.
struct VertexState {
  Stratum stratum : 2 = Stratum::volume;
  std::uint8_t normal_axes : 3 = 0;  ///< of the faces between materials that it is on, see normal_axes_of
  bool is_frozen : 1 = false;        ///< not all tets around it are in this part of the mesh
  bool is_open : 1 = true;           ///< its merges are still to be tried
};
static_assert(sizeof(VertexState) == 1);

/// A piece of the image's boundary between two materials, and the facet of the mesh that is near all of it.
struct BoundaryPiece {
  /// Coordinates of its corners are in sixteenths of a cell, so that a piece may be cut in four three times.
  static constexpr int kUnitsPerHalfCell = 8;

  std::array<LatticePoint, 3> corners{};  ///< in 1/kUnitsPerHalfCell half cells
  std::array<VertexId, 3> facet{};        ///< vertices of the facet
};

/// Tets, positively oriented, with their materials. No two vertices have the same place.
struct LatticeMesh {
  std::vector<LatticePoint> points;
  std::vector<VertexState> states;            ///< of each point
  std::vector<std::array<VertexId, 4>> tets;  ///< node order as in Mesh
  std::vector<MaterialId> materials;          ///< of each tet
  std::vector<BoundaryPiece> pieces;          ///< only when distances are bounded by more than 0
};

}  // namespace cbc3d::baselines::ld

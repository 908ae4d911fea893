// Tets of ten nodes, for solvers that want quadratic displacements.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// Nodes 0 to 3 of a tet are its corners, in Mesh's order; nodes 4 to 9 lie on its edges 01, 12, 20, 03,
/// 13, 23.
struct QuadraticMesh {
  std::vector<Vec3> points;  ///< the corners, then one for each edge; physical LPS mm
  std::size_t corners = 0;   ///< points before the first edge's
  CellBlock<10> tets;
  std::vector<std::array<VertexId, 2>> edges;  ///< the ends of every edge, the lower first, ascending
};

/// Corners at the ends of a tet's edges, in the order of the nodes 4 to 9.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kQuadraticTetEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The mesh with a node in the middle of every edge. Points that no tet uses stay. Throws InputError for a
/// mesh with other cells than tets.
QuadraticMesh straight_quadratic_mesh(const Mesh& mesh);

/// Reverses the orientation of every tet.
void flip_orientation(QuadraticMesh& mesh);

/// The straight tets of the corners.
Mesh corner_mesh(const QuadraticMesh& mesh);

}  // namespace cbc3d

// Quadratic tets whose edges on boundaries follow them, and which keep the volumes of labels.
//
// The mesher puts vertices where flat facets enclose the volumes of labels, on round parts beyond the
// boundary. Edges' nodes as far beyond it would add to the volumes; on the boundary itself, but for an offset
// (node_offsets.hpp), they keep them, wherever the vertices are.
//
// Notation: boundary edge  an edge of facets between two materials, the outside counting as background;
//           move           by which an edge's node leaves the middle of its edge.
#pragma once

#include <cstddef>
#include <map>

#include "mesher/domain/image_domain.hpp"
#include "mesher/topology/material_mesh.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {

struct CurveOptions {
  /// The Jacobian of a tet stays above this share of the straight tet's everywhere.
  double least_jacobian = 0.5;
  /// An edge's node moves no farther than this share of the edge's length.
  double greatest_move = 0.2;
};

struct CurveReport {
  std::size_t boundary_edges = 0;
  std::size_t curved = 0;              ///< boundary edges whose node moved
  std::size_t held_back = 0;           ///< of them, those that moved less than they should for a tet's sake
  std::size_t straight = 0;            ///< boundary edges that stayed straight for a tet's sake
  double least_jacobian = 1;           ///< of all tets, as a share of the straight tet's
  std::map<Label, double> volume_mm3;  ///< of every label's curved tets
};

/// The mesh in physical space with a node on every edge; vertices stay. The node of a boundary edge moves
/// along the boundary's normal to the boundary and farther by the offset with which the curved tets of every
/// material have its volume in the domain together. It stays in the middle where three or more materials
/// meet, where the boundary is not close, and where a tet would suffer; elsewhere edges are straight.
/// Parallel, alike at any thread count, linear in the tets. Throws InputError for a mesh with other cells
/// than tets.
QuadraticMesh curved_quadratic_mesh(const MaterialMesh& mesh, const ImageDomain& domain,
                                    const CurveOptions& options, CurveReport& report);

}  // namespace cbc3d

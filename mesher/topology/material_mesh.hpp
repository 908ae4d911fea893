// The mesh between lattice and output: local mm, materials in place of labels.
//
// Notation: cell  a tet, pyramid or hex; cells are numbered in this order, all tets first;
//           facet a triangle or quadrilateral of a cell.
#pragma once

#include <span>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// Cells of one kind with their materials; node orders are those of Mesh.
template <std::size_t Nodes>
struct MaterialCells {
  UninitializedVector<std::array<VertexId, Nodes>> nodes;
  std::vector<MaterialId> materials;

  [[nodiscard]] std::size_t size() const { return nodes.size(); }
  void add(const std::array<VertexId, Nodes>& cell, MaterialId material) {
    nodes.push_back(cell);
    materials.push_back(material);
  }
};

struct MaterialMesh {
  std::vector<Vec3> points;           ///< local mm
  TetNodes tets;                      ///< positively oriented
  std::vector<MaterialId> materials;  ///< one a tet
  MaterialCells<5> pyramids;          ///< of the mixed mesh only
  MaterialCells<8> hexes;             ///< of the mixed mesh only

  [[nodiscard]] std::size_t cell_count() const { return tets.size() + pyramids.size() + hexes.size(); }
  /// Nodes of a cell: 4, 5 or 8.
  [[nodiscard]] std::span<const VertexId> nodes_of(CellId cell) const {
    if (cell < tets.size()) {
      return tets[cell];
    }
    cell -= static_cast<CellId>(tets.size());
    if (cell < pyramids.size()) {
      return pyramids.nodes[cell];
    }
    return hexes.nodes[cell - pyramids.size()];
  }
  [[nodiscard]] MaterialId material_of(CellId cell) const {
    if (cell < tets.size()) {
      return materials[cell];
    }
    cell -= static_cast<CellId>(tets.size());
    return cell < pyramids.size() ? pyramids.materials[cell] : hexes.materials[cell - pyramids.size()];
  }
};

/// The cells of all kinds around each vertex. Parallel.
VertexCells cells_of_vertices(const MaterialMesh& mesh);

/// The tets that are not background, with only the vertices they use; the order of both is kept.
MaterialMesh discard_background(const std::vector<Vec3>& points, const TetNodes& tets,
                                const std::vector<MaterialId>& materials);

/// Drops the vertices that no cell uses; the order of the others is kept.
void drop_unused_vertices(MaterialMesh& mesh);

/// Renumbers vertices along a Morton curve and sorts the tets by their smallest vertex, so that what is near
/// in space is near in memory. For meshes of tets alone.
void order_for_locality(MaterialMesh& mesh);

/// The mesh in physical space with the image's label values.
Mesh to_physical_mesh(const MaterialMesh& mesh, const LabelImage& image);

/// A mesh from a file in the image's local frame, its labels as the image's materials. Throws InputError for
/// a label that the image has not, and for wedges, which the method does not make.
MaterialMesh to_material_mesh(Mesh mesh, const LabelImage& image);

}  // namespace cbc3d

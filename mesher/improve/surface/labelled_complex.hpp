// A mesh whose tets stay where they are while they are relabelled: tets that are left out stay as background,
// so that adjacency does not change.
#pragma once

#include <span>

#include "mesher/topology/material_mesh.hpp"
#include "mesher/topology/material_set.hpp"

namespace cbc3d {

class LabelledComplex {
 public:
  LabelledComplex(MaterialMesh& mesh, const std::vector<MaterialId>& label_of)
      : mesh_(mesh),
        label_of_(label_of),
        neighbours_(tet_neighbours(mesh.tets, mesh.points.size())),
        around_(tets_of_vertices(mesh.tets, mesh.points.size())),
        sets_(vertex_materials(mesh.tets, mesh.materials, neighbours_, mesh.points.size())) {}

  [[nodiscard]] const MaterialMesh& mesh() const { return mesh_; }
  [[nodiscard]] const MaterialSet& set(VertexId v) const { return sets_[v]; }
  [[nodiscard]] const std::vector<MaterialSet>& sets() const { return sets_; }
  [[nodiscard]] std::span<const TetId> star(VertexId v) const { return around_.of(v); }
  [[nodiscard]] MaterialId material(TetId t) const { return mesh_.materials[t]; }
  /// True when the tet has the label that the material is of.
  [[nodiscard]] bool has_label_of(TetId t, MaterialId material) const {
    return label_of_[mesh_.materials[t]] == label_of_[material];
  }
  [[nodiscard]] TetId neighbour(TetId t, std::size_t n) const { return neighbours_[t][n]; }
  [[nodiscard]] MaterialId across(TetId t, std::size_t n) const {
    return neighbours_[t][n] == kNoTet ? kBackground : mesh_.materials[neighbours_[t][n]];
  }
  /// True when the face is an outer one, or lies between two labels and has a vertex on the outside, and this
  /// is the side from which it counts. Faces that lie deeper intersect nothing while all tets are positive.
  [[nodiscard]] bool is_facet(TetId t, std::size_t n) const;
  void relabel(TetId t, MaterialId material) { mesh_.materials[t] = material; }

  void renew_set(VertexId v);

  /// True when the facets of a material's label at v, those between it and everything else, form one fan
  /// around v, or when there are none.
  [[nodiscard]] bool is_manifold_at(VertexId v, MaterialId material) const;

 private:
  using LinkEdges = std::vector<std::array<VertexId, 2>>;

  void add_link_edge(TetId t, std::size_t n, VertexId v, LinkEdges& link) const;
  /// Adds the outer facets: faces without neighbour.
  void add_open_faces(VertexId v, LinkEdges& link) const;
  [[nodiscard]] static bool is_one_cycle(const LinkEdges& link);

  MaterialMesh& mesh_;
  const std::vector<MaterialId>& label_of_;
  TetNeighbours neighbours_;
  VertexCells around_;
  std::vector<MaterialSet> sets_;
};

/// Takes the background tets out; vertices keep their numbers.
void remove_background(MaterialMesh& mesh);

}  // namespace cbc3d

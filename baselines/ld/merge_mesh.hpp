// The mesh that is decimated: the tets around every vertex at hand, and the merge of two vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/ld/lattice_mesh.hpp"

namespace cbc3d::baselines::ld {

using TetId = std::uint32_t;

/// A lattice mesh whose vertices can be merged. The corners of tets at a vertex form a linked list, so that a
/// merge appends one list to another and no element has memory of its own.
class MergeMesh {
 public:
  explicit MergeMesh(LatticeMesh mesh);
  /// What is left: vertices and tets in their order, numbered anew; pieces as they are given.
  [[nodiscard]] LatticeMesh release();

  [[nodiscard]] std::size_t vertex_count() const { return mesh_.points.size(); }
  /// False once the vertex was merged into another, or when no tet had it.
  [[nodiscard]] bool is_alive(VertexId v) const { return first_[v] != kEnd; }
  [[nodiscard]] const LatticePoint& point(VertexId v) const { return mesh_.points[v]; }
  [[nodiscard]] VertexState& state(VertexId v) { return mesh_.states[v]; }
  [[nodiscard]] const VertexState& state(VertexId v) const { return mesh_.states[v]; }
  [[nodiscard]] const std::array<VertexId, 4>& nodes(TetId t) const { return mesh_.tets[t]; }
  [[nodiscard]] MaterialId material(TetId t) const { return mesh_.materials[t]; }
  [[nodiscard]] std::vector<BoundaryPiece>& pieces() { return mesh_.pieces; }

  /// Calls f(tet, which of its nodes is v) for the tets around v, and takes dead ones out of its list.
  template <typename F>
  void for_star(VertexId v, const F& f) {
    std::uint32_t* link = &first_[v];
    while (*link != kEnd) {
      const std::uint32_t corner = *link;
      if (is_dead(corner / 4)) {
        *link = next_[corner];
        continue;
      }
      f(corner / 4, corner % 4);
      link = &next_[corner];
    }
  }

  /// Puts w in the place of v: tets with both vanish.
  void merge(VertexId v, VertexId w);

 private:
  static constexpr std::uint32_t kEnd = 0xFFFFFFFFU;

  [[nodiscard]] bool is_dead(TetId t) const { return mesh_.tets[t][0] == kNoVertex; }

  LatticeMesh mesh_;
  std::vector<std::uint32_t> first_;  // of a vertex: a corner, number 4 tet + node
  std::vector<std::uint32_t> next_;   // of a corner: the next at the same vertex
};

}  // namespace cbc3d::baselines::ld

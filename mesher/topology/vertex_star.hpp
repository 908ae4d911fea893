// Is the surface of a material a manifold at a vertex?
//
// Notation: star  the tets around a vertex;  class  what counts as one material (a label, say);
//           link  the triangulated sphere that the star's outer faces form.
//
// The tets of a class cut a part out of the link. Its rim is one closed curve, that is, the surface of the
// class is a disc at the vertex, exactly when both the part and the rest of the link are connected across
// edges: when the class's tets of the star are face-connected, and all others are too. A non-manifold edge at
// the vertex fails this test as well, because on a sphere the two sheets that meet at the edge separate
// either the part or the rest.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

using ClassId = std::uint16_t;

/// Splits the star of one vertex into face-connected pieces. Reusable: one object a thread, no allocation
/// once warm.
class VertexStar {
 public:
  VertexStar(const VertexCells& around, const TetNodes& tets, const TetNeighbours& neighbours)
      : around_(around), tets_(tets), neighbours_(neighbours) {}

  /// Loads the star of `vertex`. The outside of the mesh, where the star has faces towards it, counts as one
  /// more member of the class `outside`.
  void load(VertexId vertex, const std::vector<ClassId>& class_of_tet, ClassId outside);

  [[nodiscard]] std::size_t size() const { return members_.size(); }
  /// The tet of member i, kNoTet for the outside.
  [[nodiscard]] TetId tet(std::size_t i) const { return members_[i]; }
  [[nodiscard]] ClassId class_of(std::size_t i) const { return classes_[i]; }
  /// The distinct classes of the star, ascending.
  [[nodiscard]] const std::vector<ClassId>& distinct() const { return distinct_; }

  /// Numbers the face-connected pieces of the members that are of the class (or, when not `inside`, that are
  /// not). piece(i) is then the piece of member i, -1 for members on the other side. Returns the number of
  /// pieces.
  int split(ClassId of, bool inside);
  [[nodiscard]] int piece(std::size_t i) const { return piece_[i]; }

  /// True when the surface of the class is a manifold at the vertex.
  bool is_manifold(ClassId of) { return split(of, true) <= 1 && split(of, false) <= 1; }

 private:
  const VertexCells& around_;
  const TetNodes& tets_;
  const TetNeighbours& neighbours_;
  std::vector<TetId> members_;
  std::vector<ClassId> classes_;
  std::vector<ClassId> distinct_;
  std::vector<std::array<std::int16_t, 3>> adjacent_;  // members across the three faces at the vertex
  std::vector<int> piece_;
  std::vector<std::int16_t> stack_;
};

}  // namespace cbc3d

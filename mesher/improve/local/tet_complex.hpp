// A tet mesh that changes: vertices move, groups of tets are replaced by others.
//
// Notation: star      the tets around a vertex;
//           ring      the vertices around an edge, in order, with the tets between them;
//           facet     a face between two materials; the outside counts as background;
//           locked    a vertex that must stay, with every face between locked vertices alone: its star may go
//                     on outside the complex;
//           fixed     a vertex that must stay, with every tet between fixed and locked vertices alone. Its
//           star is complete, so that other vertices may collapse onto it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/topology/material_set.hpp"

namespace cbc3d {

/// A tet to be put in place of others.
struct FreshTet {
  std::array<VertexId, 4> nodes;
  MaterialId material;
};

/// A facet at a vertex: the other two nodes, counter-clockwise seen from `outer`, and the materials on its
/// two sides.
struct FacetAt {
  VertexId first, second;
  MaterialId inner, outer;  ///< inner is greater than outer
};

/// The tets around the edge a, b: tets[i] has the ring vertices i and i + 1, and (a, b, ring[i], ring[i + 1])
/// is positive. A closed ring has as many tets as vertices, an open one (an edge on the outside) one less.
struct EdgeRing {
  std::vector<VertexId> vertices;
  std::vector<TetId> tets;
  bool closed = false;
};

class TetComplex {
 public:
  /// What holds a vertex.
  enum Hold : std::uint8_t { kFree, kLocked, kFixed };

  /// All tets must be positive and conforming. `hold` has one entry per vertex.
  TetComplex(std::vector<Vec3> points, TetNodes tets, std::vector<MaterialId> materials,
             std::vector<std::uint8_t> hold);

  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  [[nodiscard]] std::size_t tet_slots() const { return tets_.size(); }
  [[nodiscard]] bool alive(TetId t) const { return tets_[t][0] != kNoVertex; }
  [[nodiscard]] bool in_use(VertexId v) const { return tet_at_[v] != kNoTet; }
  [[nodiscard]] bool locked(VertexId v) const { return hold_[v] == kLocked; }
  /// Neither locked nor fixed.
  [[nodiscard]] bool free(VertexId v) const { return hold_[v] == kFree; }
  [[nodiscard]] const std::array<VertexId, 4>& nodes(TetId t) const { return tets_[t]; }
  [[nodiscard]] MaterialId material(TetId t) const { return materials_[t]; }
  [[nodiscard]] TetId across(TetId t, unsigned n) const { return across_[t][n]; }
  [[nodiscard]] MaterialId material_across(TetId t, unsigned n) const {
    return across_[t][n] == kNoTet ? kBackground : materials_[across_[t][n]];
  }
  [[nodiscard]] const Vec3& point(VertexId v) const { return points_[v]; }
  void move(VertexId v, const Vec3& to) { points_[v] = to; }
  void lock(VertexId v) { hold_[v] = kLocked; }
  [[nodiscard]] double quality(TetId t) const;

  /// The star of a vertex that is in use; complete only where the vertex is not locked.
  void star(VertexId v, std::vector<TetId>& tets) const;
  /// The vertices joined to v by an edge of the star's tets, in order of first sight.
  void neighbours(VertexId v, std::span<const TetId> star, std::vector<VertexId>& vertices) const;
  /// The materials of a star, the outside included where the star has faces towards it.
  [[nodiscard]] MaterialSet materials(VertexId v, std::span<const TetId> star) const;
  /// The facets at v, each once.
  void facets(VertexId v, std::span<const TetId> star, std::vector<FacetAt>& facets) const;
  /// The ring of an edge, of which one end is not locked; false when no tet has both.
  bool ring(VertexId a, VertexId b, EdgeRing& ring) const;

  /// Replaces tets by others that fill the same space (or, at the outside, another). Vertices that lose their
  /// last tet are out of use afterwards. False, and nothing done, where a face would belong to more than two
  /// tets, as can happen where the outside is pinched.
  bool replace(std::span<const TetId> old, std::span<const FreshTet> fresh);
  /// A new vertex without tets.
  VertexId add_vertex(const Vec3& point);

  [[nodiscard]] unsigned node_index(TetId t, VertexId v) const {
    const auto& n = tets_[t];
    return n[0] == v ? 0 : n[1] == v ? 1 : n[2] == v ? 2 : 3;
  }
  [[nodiscard]] bool has_node(TetId t, VertexId v) const {
    const auto& n = tets_[t];
    return n[0] == v || n[1] == v || n[2] == v || n[3] == v;
  }

 private:
  using Face = std::array<VertexId, 3>;
  struct OpenFace {
    Face key;           // sorted
    TetId tet;          // or the index of a fresh one
    std::uint8_t node;  // opposite to the face
    bool fresh;
    [[nodiscard]] bool same_key(const OpenFace& other) const {  // a call of memcmp costs more
      return key[0] == other.key[0] && key[1] == other.key[1] && key[2] == other.key[2];
    }
  };
  /// A star that was asked for last.
  struct KnownStar {
    VertexId vertex = kNoVertex;
    std::vector<TetId> tets;
  };
  /// Visits a star's tets until one ends the walk, which is returned; kNoTet: none did, `tets` is the star.
  template <typename Ends>
  TetId walk_star(VertexId v, std::vector<TetId>& tets, const Ends& ends) const;
  /// Across the face of a, b and `keep`; `t` has all three.
  [[nodiscard]] TetId across_ring(TetId t, VertexId a, VertexId b, VertexId keep) const;
  /// The two vertices of t that are not a or b, in the positive sense around ab.
  [[nodiscard]] std::array<VertexId, 2> ring_ends(TetId t, VertexId a, VertexId b) const;
  /// Backwards from `found` to the outside, or `found` itself after a full turn.
  TetId first_of_ring(TetId found, VertexId a, VertexId b, bool& closed) const;
  TetId take_slot();
  void collect_faces(std::span<const TetId> old, std::span<const FreshTet> fresh);
  [[nodiscard]] bool faces_fit(std::span<const TetId> old);
  [[nodiscard]] bool is_elsewhere(const Face& face, std::span<const TetId> old);
  void remove(std::span<const TetId> old);

  std::vector<Vec3> points_;
  TetNodes tets_;
  std::vector<MaterialId> materials_;
  TetNeighbours across_;
  std::vector<TetId> tet_at_;       // some tet of each vertex
  std::vector<std::uint8_t> hold_;  // of each vertex, a Hold
  std::vector<TetId> free_;
  std::vector<OpenFace> faces_;  // scratch of replace
  std::vector<TetId> placed_;    // likewise
  KnownStar known_;              // likewise
  mutable std::vector<std::uint32_t> seen_;
  mutable std::uint32_t stamp_ = 0;
};

}  // namespace cbc3d

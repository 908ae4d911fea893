// The adaptive BCC lattice: exact integer vertices, red tets, and the green closure derived from them.
//
// Notation (paper, section "Adaptive Lattice Refinement"):
//   a            lattice spacing in mm: the edge of a cube of the coarsest level
//   level l      red tets of level l are BCC tets of the lattice with spacing a / 2^l
//   red tet      a regular tet: congruent (up to scale) to the coarse ones, may be split 1:8
//   green tet    a piece of a red tet that has split edges but is not split itself (1:2 or 1:4); never kept,
//                always derived anew, so that it is "replaced by its red parent when it must split" for free
//   unit         the finest half-spacing, a / 2^(max_level+1); every vertex is an integer triple in units
//
// A point of the level-(l+1) lattice that is no vertex of level l is the midpoint of exactly one level-l
// edge. Hence "the edge is split" and "its midpoint is in the vertex table" are the same statement, and the
// table of vertices plus the list of red leaves is the whole state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// Integer coordinates of a lattice vertex, in units, each in [0, 2^21).
using LatticePoint = std::array<std::int32_t, 3>;

inline LatticePoint midpoint(const LatticePoint& a, const LatticePoint& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Edges of a tet by their end nodes; edge e and edge 5 - e are opposite. Edges 0 and 5 are the long ones of
/// a red tet.
inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kRedEdge = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Maps lattice units to an image's local mm.
struct LatticeFrame {
  Vec3 origin_mm;      ///< local position of the lattice point (0,0,0)
  double unit_mm = 1;  ///< length of one unit
  int max_level = 0;   ///< no red tet is finer than this

  [[nodiscard]] Vec3 local(const LatticePoint& p) const {
    return origin_mm +
           Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])} * unit_mm;
  }
  /// Edge of a cube of the level, mm: the length of the two long edges of its tets.
  [[nodiscard]] double spacing_mm(int level) const {
    return unit_mm * static_cast<double>(2 << (max_level - level));
  }
};

/// Lattice point -> vertex number; open addressing, one flat array.
class VertexTable {
 public:
  [[nodiscard]] VertexId find(const LatticePoint& point) const;
  /// The number of the vertex at `point`, which becomes `next` if there was none.
  VertexId find_or_insert(const LatticePoint& point, VertexId next);

  /// Many threads insert together: each claims the slots of its points, where the smallest number asked for
  /// stays, and when all have done so gives those that it won their final numbers. `reserve` comes before,
  /// for the most points that can be new, and `inserted` when it is known how many are.
  void reserve(std::size_t more);
  std::uint32_t claim(const LatticePoint& point, VertexId number);
  [[nodiscard]] VertexId vertex_in(std::uint32_t slot) const { return slots_[slot].vertex; }
  void set_vertex(std::uint32_t slot, VertexId vertex) { slots_[slot].vertex = vertex; }
  void inserted(std::size_t count) { count_ += count; }

 private:
  struct Slot {
    std::uint64_t key;
    VertexId vertex;
  };
  static std::uint64_t key_of(const LatticePoint& point);
  [[nodiscard]] std::size_t first_slot_of(std::uint64_t key) const;
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  void grow();

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

/// A leaf of the red refinement. Nodes 0-1 and 2-3 are its two long edges; positively oriented.
struct RedTet {
  std::array<VertexId, 4> nodes;
  std::int8_t level;
  std::uint8_t split;  ///< bit e: edge e (of kRedEdge) is split; kept by RedGreenRefiner
};

struct Lattice {
  LatticeFrame frame;
  std::vector<LatticePoint> points;
  /// One more than the level of the finest split edge at each vertex, 0 where none is: spares look-ups in the
  /// table.
  std::vector<std::int8_t> split_below;
  VertexTable table;
  UninitializedVector<RedTet> reds;

  VertexId vertex_at(const LatticePoint& point);
};

/// The lattice's vertices in local mm.
std::vector<Vec3> local_points(const Lattice& lattice);
/// The same, where `points` has the first of them already.
void append_local_points(const Lattice& lattice, std::vector<Vec3>& points);

/// A conforming mesh of the lattice: its red leaves and the green pieces of those with split edges.
struct LatticeTets {
  TetNodes nodes;                             ///< positively oriented
  UninitializedVector<std::uint32_t> parent;  ///< index into Lattice::reds
  UninitializedVector<std::uint8_t> green;    ///< 1 for a green piece

  [[nodiscard]] std::size_t size() const { return nodes.size(); }
  /// New tets have no value.
  void resize(std::size_t tets) {
    nodes.resize(tets);
    parent.resize(tets);
    green.resize(tets);
  }
};

}  // namespace cbc3d

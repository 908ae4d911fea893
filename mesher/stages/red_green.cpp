#include "mesher/stages/red_green.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

// Edges of a tet by their end nodes; edge e and edge 5 - e are opposite. Edges 0 and 5 are the long ones of a
// red tet.
constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdge = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// The edges of the face opposite to each node, as a bit set.
constexpr std::array<unsigned, 4> kFaceEdges = {
    (1U << 3) | (1U << 4) | (1U << 5), (1U << 1) | (1U << 2) | (1U << 5), (1U << 0) | (1U << 2) | (1U << 4),
    (1U << 0) | (1U << 1) | (1U << 3)};

LatticePoint midpoint(const LatticePoint& a, const LatticePoint& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// The middle of the edge a-b of the level if it is split, else kNoVertex. A segment of one unit has no
/// midpoint in the lattice.
VertexId middle_of(const Lattice& lattice, VertexId a, VertexId b, int level) {
  if (lattice.split_below[a] <= level || lattice.split_below[b] <= level) {
    return kNoVertex;
  }
  const LatticePoint& p = lattice.points[a];
  const LatticePoint& q = lattice.points[b];
  for (std::size_t d = 0; d < 3; ++d) {
    if (((p[d] + q[d]) & 1) != 0) {
      return kNoVertex;
    }
  }
  return lattice.table.find(midpoint(p, q));
}

/// How a red tet stands among its neighbours.
struct Pattern {
  unsigned split = 0;     ///< bit e: edge e is split
  bool too_deep = false;  ///< a neighbour is finer than a green piece could meet
};

Pattern pattern_of(const Lattice& lattice, const RedTet& red) {
  Pattern pattern;
  const int finer = red.level + 1;
  const auto is_split = [&](VertexId a, VertexId b) { return middle_of(lattice, a, b, finer) != kNoVertex; };
  std::array<VertexId, 6> mid;
  for (unsigned e = 0; e < 6; ++e) {
    const VertexId a = red.nodes[kEdge[e][0]];
    const VertexId b = red.nodes[kEdge[e][1]];
    mid[e] = middle_of(lattice, a, b, red.level);
    if (mid[e] != kNoVertex) {
      pattern.split |= 1U << e;
      pattern.too_deep = pattern.too_deep || is_split(a, mid[e]) || is_split(mid[e], b);
    }
  }
  for (const unsigned face : kFaceEdges) {
    if ((pattern.split & face) == face && !pattern.too_deep) {
      std::array<unsigned, 3> edges{};
      std::size_t n = 0;
      for (unsigned e = 0; e < 6; ++e) {
        if ((face >> e & 1U) != 0) {
          edges[n++] = e;
        }
      }
      pattern.too_deep = is_split(mid[edges[0]], mid[edges[1]]) || is_split(mid[edges[1]], mid[edges[2]]) ||
                         is_split(mid[edges[2]], mid[edges[0]]);
    }
  }
  return pattern;
}

/// What the closure asks of a red tet: the edges to be split in addition, or a red split. demand_of notes its
/// split edges.
struct Demand {
  std::uint8_t extra = 0;
  bool red = false;
};

Demand demand_of(const Lattice& lattice, RedTet& red) {
  const Pattern pattern = pattern_of(lattice, red);
  const unsigned split = pattern.split;
  red.split = static_cast<std::uint8_t>(split);
  if (split == 0) {
    return {};
  }
  if (pattern.too_deep) {
    return {0, true};
  }
  unsigned closed = split;  // with the third edge of every face that has two
  for (const unsigned face : kFaceEdges) {
    const unsigned of_face = split & face;
    if (of_face != 0 && (of_face & (of_face - 1)) != 0) {
      closed |= face;
    }
  }
  const bool one = (closed & (closed - 1)) == 0;
  const bool face = std::find(kFaceEdges.begin(), kFaceEdges.end(), closed) != kFaceEdges.end();
  const bool opposite = closed == ((1U << 0) | (1U << 5)) || closed == ((1U << 1) | (1U << 4)) ||
                        closed == ((1U << 2) | (1U << 3));
  if (one || face || opposite) {
    return {static_cast<std::uint8_t>(closed & ~split), false};
  }
  return {0, true};
}

/// Runs the closure. A sweep looks (in parallel, at a state that nobody changes) at the red tets that the
/// last sweep can have touched, then acts in order. A new midpoint on the edge a-b concerns the tets with
/// that edge, those of whose edges it is one half (a or b is a node of theirs), and those of whose faces it
/// is an inner segment (all three edges of that face are split): so nodes carry the number of the sweep that
/// last split an edge at them.
class Closure {
 public:
  explicit Closure(Lattice& lattice) : lattice_(lattice), last_touched_(lattice.points.size(), 0) {}

  std::size_t run(const std::vector<std::uint8_t>& marked) {
    const std::size_t count = lattice_.reds.size();
    for (std::size_t t = 0; t < count; ++t) {
      if (marked[t] != 0 && lattice_.reds[t].level < lattice_.frame.max_level) {
        split_red(t);
      }
    }
    for (bool changed = split_count_ > 0; changed;) {
      ++sweep_;
      changed = sweep();
    }
    return split_count_;
  }

 private:
  [[nodiscard]] bool is_concerned(const RedTet& red) const {
    for (const VertexId v : red.nodes) {
      if (last_touched_[v] + 1 == sweep_) {
        return true;
      }
    }
    return std::any_of(kFaceEdges.begin(), kFaceEdges.end(), [&](unsigned face) {
      return (red.split & face) == face && is_touched_inside(red, face);
    });
  }

  /// True when an inner segment of the face may have been split by the last sweep: each has its ends at two
  /// of the three midpoints, so two of them are enough to look at.
  [[nodiscard]] bool is_touched_inside(const RedTet& red, unsigned face) const {
    for (unsigned edges = face & (face - 1); edges != 0; edges &= edges - 1) {
      const auto e = static_cast<unsigned>(std::countr_zero(edges));
      const LatticePoint& a = lattice_.points[red.nodes[kEdge[e][0]]];
      const LatticePoint& b = lattice_.points[red.nodes[kEdge[e][1]]];
      if (last_touched_[lattice_.table.find(midpoint(a, b))] + 1 == sweep_) {
        return true;
      }
    }
    return false;
  }

  bool sweep() {
    const std::size_t count = lattice_.reds.size();
    std::vector<Demand> demands(count);
#pragma omp parallel for schedule(static, 4096)
    for (std::size_t t = 0; t < count; ++t) {
      if (is_concerned(lattice_.reds[t])) {
        demands[t] = demand_of(lattice_, lattice_.reds[t]);
      }
    }
    const std::vector<std::uint32_t> demanding =
        indices_where(count, [&](std::size_t t) { return demands[t].red || demands[t].extra != 0; });
    for (const std::uint32_t t : demanding) {
      if (demands[t].red) {
        split_red(t);
      } else {
        split_edges(lattice_.reds[t], demands[t].extra);
      }
    }
    return !demanding.empty();
  }

  VertexId split_edge(VertexId a, VertexId b, int level) {
    const std::size_t before = lattice_.points.size();
    const VertexId middle = lattice_.vertex_at(midpoint(lattice_.points[a], lattice_.points[b]));
    if (middle == before) {
      last_touched_.push_back(sweep_);
      last_touched_[a] = last_touched_[b] = sweep_;
      for (const VertexId end : {a, b}) {
        std::int8_t& below = lattice_.split_below[end];
        below = std::max(below, static_cast<std::int8_t>(level + 1));
      }
    }
    return middle;
  }

  void split_edges(const RedTet& red, unsigned edges) {
    for (unsigned e = 0; e < 6; ++e) {
      if ((edges >> e & 1U) != 0) {
        split_edge(red.nodes[kEdge[e][0]], red.nodes[kEdge[e][1]], red.level);
      }
    }
  }

  /// Splits the tet at `index` in eight; the first child takes its place, the others go to the end. All
  /// children have a midpoint among their nodes, which is touched, so the next sweep looks at them.
  void split_red(std::size_t index) {
    const RedTet red = lattice_.reds[index];
    std::array<VertexId, 6> m;
    for (unsigned e = 0; e < 6; ++e) {
      m[e] = split_edge(red.nodes[kEdge[e][0]], red.nodes[kEdge[e][1]], red.level);
      last_touched_[m[e]] = sweep_;
    }
    const auto& [a, b, c, d] = red.nodes;
    const VertexId ab = m[0], ac = m[1], ad = m[2], bc = m[3], bd = m[4], cd = m[5];
    // The shortest inner diagonal joins the midpoints of the two long edges, ab and cd. Every child is
    // written so that its long edges are again 0-1 and 2-3 and its orientation is the parent's.
    const std::array<std::array<VertexId, 4>, 8> children = {{{a, ab, ac, ad},
                                                              {ab, b, bc, bd},
                                                              {ac, bc, c, cd},
                                                              {ad, bd, cd, d},
                                                              {ab, cd, ac, ad},
                                                              {ab, cd, bc, ac},
                                                              {ab, cd, bd, bc},
                                                              {ab, cd, ad, bd}}};
    const auto level = static_cast<std::int8_t>(red.level + 1);
    lattice_.reds[index] = {children[0], level, 0};
    for (std::size_t n = 1; n < children.size(); ++n) {
      lattice_.reds.push_back({children[n], level, 0});
    }
    ++split_count_;
  }

  Lattice& lattice_;
  std::vector<std::uint32_t> last_touched_;  // per vertex
  std::uint32_t sweep_ = 1;
  std::size_t split_count_ = 0;
};

/// Writes the tets of one red tet.
class PieceWriter {
 public:
  PieceWriter(const Lattice& lattice, LatticeTets& tets, std::size_t first)
      : lattice_(lattice), tets_(tets), next_(first) {}

  void write(std::size_t t) { emit(t, lattice_.reds[t].split); }

 private:
  void emit(std::size_t t, unsigned split) {
    const auto& nodes = lattice_.reds[t].nodes;
    if (split == 0) {
      add(t, nodes, 0);
    } else if ((split & (split - 1)) == 0) {
      emit_halves(t, first_edge(split));
    } else if (const auto face = std::find(kFaceEdges.begin(), kFaceEdges.end(), split);
               face != kFaceEdges.end()) {
      emit_face(t, static_cast<std::size_t>(face - kFaceEdges.begin()));
    } else {
      emit_opposite(t, first_edge(split));
    }
  }

  static unsigned first_edge(unsigned split) { return static_cast<unsigned>(std::countr_zero(split)); }

  /// 1:2 by one edge.
  void emit_halves(std::size_t t, unsigned e) {
    const VertexId m = mid(t, kEdge[e][0], kEdge[e][1]);
    for (const std::uint8_t end : kEdge[e]) {
      std::array<VertexId, 4> half = lattice_.reds[t].nodes;
      half[end] = m;
      add(t, half, 1);
    }
  }

  /// 1:4 by two opposite edges: each end of the one with each end of the other.
  void emit_opposite(std::size_t t, unsigned e) {
    const unsigned o = 5 - e;
    const VertexId m = mid(t, kEdge[e][0], kEdge[e][1]);
    const VertexId n = mid(t, kEdge[o][0], kEdge[o][1]);
    for (const std::uint8_t end : kEdge[e]) {
      for (const std::uint8_t other : kEdge[o]) {
        std::array<VertexId, 4> quarter = lattice_.reds[t].nodes;
        quarter[end] = m;
        quarter[other] = n;
        add(t, quarter, 1);
      }
    }
  }

  /// 1:4 by the three edges of the face opposite to `apex`.
  void emit_face(std::size_t t, std::size_t apex) {
    std::array<std::size_t, 3> corner{};
    std::size_t n = 0;
    for (std::size_t node = 0; node < 4; ++node) {
      if (node != apex) {
        corner[n++] = node;
      }
    }
    std::array<VertexId, 4> middle = lattice_.reds[t].nodes;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      const std::size_t last = (c + 2) % 3;
      std::array<VertexId, 4> piece = lattice_.reds[t].nodes;
      piece[corner[next]] = mid(t, corner[c], corner[next]);
      piece[corner[last]] = mid(t, corner[c], corner[last]);
      add(t, piece, 1);
      middle[corner[c]] = mid(t, corner[next], corner[last]);  // the medial triangle, turned by half a turn
    }
    add(t, middle, 1);
  }

  [[nodiscard]] VertexId mid(std::size_t t, std::size_t a, std::size_t b) const {
    const auto& nodes = lattice_.reds[t].nodes;
    return lattice_.table.find(midpoint(lattice_.points[nodes[a]], lattice_.points[nodes[b]]));
  }

  void add(std::size_t t, const std::array<VertexId, 4>& nodes, std::uint8_t green) {
    tets_.nodes[next_] = nodes;
    tets_.parent[next_] = static_cast<std::uint32_t>(t);
    tets_.green[next_++] = green;
  }

  const Lattice& lattice_;
  LatticeTets& tets_;
  std::size_t next_;
};

}  // namespace

std::size_t refine_red_green(Lattice& lattice, const std::vector<std::uint8_t>& marked) {
  return Closure(lattice).run(marked);
}

std::uint32_t piece_count(const RedTet& red) {
  return red.split == 0 ? 1 : std::has_single_bit(red.split) ? 2 : 4;
}

void write_pieces(const Lattice& lattice, std::size_t red, std::size_t first, LatticeTets& tets) {
  PieceWriter(lattice, tets, first).write(red);
}

LatticeTets extract_tets(const Lattice& lattice) {
  std::vector<std::size_t> first(lattice.reds.size() + 1, 0);
  for (std::size_t r = 0; r < lattice.reds.size(); ++r) {
    first[r + 1] = first[r] + piece_count(lattice.reds[r]);
  }
  LatticeTets tets;
  tets.resize(first.back());
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t r = 0; r < lattice.reds.size(); ++r) {
    write_pieces(lattice, r, first[r], tets);
  }
  return tets;
}

}  // namespace cbc3d

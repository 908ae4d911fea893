#include "mesher/stages/red_green.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace cbc3d {
namespace {

// Edges of a tet by their end nodes; edge e and edge 5 - e are opposite. Edges 0 and 5 are the long ones of a red tet.
constexpr std::array<std::array<std::uint8_t, 2>, 6> kEdge = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// The edges of the face opposite to each node, as a bit set.
constexpr std::array<unsigned, 4> kFaceEdges = {(1U << 3) | (1U << 4) | (1U << 5), (1U << 1) | (1U << 2) | (1U << 5),
                                                (1U << 0) | (1U << 2) | (1U << 4), (1U << 0) | (1U << 1) | (1U << 3)};
constexpr unsigned kAllEdges = 63;

LatticePoint midpoint(const LatticePoint& a, const LatticePoint& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// True when the segment a-b is split. A segment of one unit has no midpoint in the lattice.
bool is_split(const Lattice& lattice, const LatticePoint& a, const LatticePoint& b) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (((a[d] + b[d]) & 1) != 0) {
      return false;
    }
  }
  return lattice.table.find(midpoint(a, b)) != kNoVertex;
}

/// How a red tet stands among its neighbours.
struct Pattern {
  unsigned split = 0;      ///< bit e: edge e is split
  bool too_deep = false;   ///< a neighbour is finer than a green piece could meet
};

Pattern pattern_of(const Lattice& lattice, const RedTet& red) {
  Pattern pattern;
  std::array<LatticePoint, 6> mid;
  for (unsigned e = 0; e < 6; ++e) {
    const LatticePoint& a = lattice.points[red.nodes[kEdge[e][0]]];
    const LatticePoint& b = lattice.points[red.nodes[kEdge[e][1]]];
    if (is_split(lattice, a, b)) {
      pattern.split |= 1U << e;
      mid[e] = midpoint(a, b);
      pattern.too_deep = pattern.too_deep || is_split(lattice, a, mid[e]) || is_split(lattice, mid[e], b);
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
      pattern.too_deep = is_split(lattice, mid[edges[0]], mid[edges[1]]) || is_split(lattice, mid[edges[1]], mid[edges[2]]) ||
                         is_split(lattice, mid[edges[2]], mid[edges[0]]);
    }
  }
  return pattern;
}

/// What the closure asks of a red tet: the edges to be split in addition (all six for a red split).
struct Demand {
  unsigned extra = 0;
  bool red = false;
};

Demand demand_of(const Lattice& lattice, const RedTet& red) {
  const Pattern pattern = pattern_of(lattice, red);
  const unsigned split = pattern.split;
  if (split == 0) {
    return {};
  }
  if (pattern.too_deep) {
    return {kAllEdges & ~split, true};
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
    return {closed & ~split, false};
  }
  return {kAllEdges & ~split, true};
}

/// Splits the tet at `index` in eight; the first child takes its place, the others go to the end.
void split_red(Lattice& lattice, std::size_t index) {
  const RedTet red = lattice.reds[index];
  std::array<VertexId, 6> m;
  for (unsigned e = 0; e < 6; ++e) {
    const LatticePoint a = lattice.points[red.nodes[kEdge[e][0]]];
    const LatticePoint b = lattice.points[red.nodes[kEdge[e][1]]];
    m[e] = lattice.vertex_at(midpoint(a, b));
  }
  const auto& [a, b, c, d] = red.nodes;
  const VertexId ab = m[0], ac = m[1], ad = m[2], bc = m[3], bd = m[4], cd = m[5];
  // The shortest inner diagonal joins the midpoints of the two long edges, ab and cd. Every child is written so that
  // its long edges are again 0-1 and 2-3 and its orientation is the parent's.
  const std::array<std::array<VertexId, 4>, 8> children = {{{a, ab, ac, ad},
                                                            {ab, b, bc, bd},
                                                            {ac, bc, c, cd},
                                                            {ad, bd, cd, d},
                                                            {ab, cd, ac, ad},
                                                            {ab, cd, bc, ac},
                                                            {ab, cd, bd, bc},
                                                            {ab, cd, ad, bd}}};
  lattice.reds[index] = {children[0], red.level + 1};
  for (std::size_t n = 1; n < children.size(); ++n) {
    lattice.reds.push_back({children[n], red.level + 1});
  }
}

void split_edges(Lattice& lattice, const RedTet& red, unsigned edges) {
  for (unsigned e = 0; e < 6; ++e) {
    if ((edges >> e & 1U) != 0) {
      const LatticePoint a = lattice.points[red.nodes[kEdge[e][0]]];
      const LatticePoint b = lattice.points[red.nodes[kEdge[e][1]]];
      lattice.vertex_at(midpoint(a, b));
    }
  }
}

/// One sweep over all red tets: looks (in parallel, at a state that nobody changes), then acts in order.
std::size_t close_once(Lattice& lattice, bool& changed) {
  const std::size_t count = lattice.reds.size();
  std::vector<Demand> demands(count);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t t = 0; t < count; ++t) {
    demands[t] = demand_of(lattice, lattice.reds[t]);
  }
  std::size_t split = 0;
  changed = false;
  for (std::size_t t = 0; t < count; ++t) {
    if (demands[t].red) {
      split_red(lattice, t);
      ++split;
      changed = true;
    } else if (demands[t].extra != 0) {
      split_edges(lattice, lattice.reds[t], demands[t].extra);
      changed = true;
    }
  }
  return split;
}

class Extractor {
 public:
  explicit Extractor(const Lattice& lattice) : lattice_(lattice) {}

  LatticeTets run() {
    tets_.nodes.reserve(lattice_.reds.size());
    tets_.parent.reserve(lattice_.reds.size());
    tets_.green.reserve(lattice_.reds.size());
    std::vector<std::uint8_t> split(lattice_.reds.size());
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < split.size(); ++t) {
      split[t] = static_cast<std::uint8_t>(pattern_of(lattice_, lattice_.reds[t]).split);
    }
    for (std::size_t t = 0; t < split.size(); ++t) {
      emit(t, split[t]);
    }
    return std::move(tets_);
  }

 private:
  void emit(std::size_t t, unsigned split) {
    const auto& nodes = lattice_.reds[t].nodes;
    if (split == 0) {
      add(t, nodes, 0);
    } else if ((split & (split - 1)) == 0) {
      emit_halves(t, first_edge(split));
    } else if (const auto face = std::find(kFaceEdges.begin(), kFaceEdges.end(), split); face != kFaceEdges.end()) {
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
    tets_.nodes.push_back(nodes);
    tets_.parent.push_back(static_cast<std::uint32_t>(t));
    tets_.green.push_back(green);
  }

  const Lattice& lattice_;
  LatticeTets tets_;
};

}  // namespace

std::size_t refine_red_green(Lattice& lattice, const std::vector<std::uint8_t>& marked) {
  std::size_t split = 0;
  for (std::size_t t = 0; t < marked.size(); ++t) {
    if (marked[t] != 0 && lattice.reds[t].level < lattice.frame.max_level) {
      split_red(lattice, t);
      ++split;
    }
  }
  for (bool changed = split > 0; changed;) {
    split += close_once(lattice, changed);
  }
  return split;
}

LatticeTets extract_tets(const Lattice& lattice) { return Extractor(lattice).run(); }

}  // namespace cbc3d

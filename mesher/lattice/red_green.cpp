#include "mesher/lattice/red_green.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <memory>
#include <utility>

#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

// The edges of the face opposite to each node, as a bit set.
constexpr std::array<unsigned, 4> kFaceEdges = {
    (1U << 3) | (1U << 4) | (1U << 5), (1U << 1) | (1U << 2) | (1U << 5), (1U << 0) | (1U << 2) | (1U << 4),
    (1U << 0) | (1U << 1) | (1U << 3)};

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

constexpr std::uint8_t kAllEdges = 0x3F;

/// Calls f(e) for the edges of a bit set, ascending.
template <typename F>
void for_each_edge(unsigned edges, const F& f) {
  for (; edges != 0; edges &= edges - 1) {
    f(static_cast<std::size_t>(std::countr_zero(edges)));
  }
}

LatticePoint middle_point(const Lattice& lattice, const RedTet& red, std::size_t edge) {
  return midpoint(lattice.points[red.nodes[kRedEdge[edge][0]]], lattice.points[red.nodes[kRedEdge[edge][1]]]);
}

/// Several threads may raise the same value.
void raise(std::int8_t& value, std::int8_t to) {
  const std::atomic_ref<std::int8_t> shared(value);
  std::int8_t now = shared.load(std::memory_order_relaxed);
  while (now < to && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
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
    const VertexId a = red.nodes[kRedEdge[e][0]];
    const VertexId b = red.nodes[kRedEdge[e][1]];
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
    const VertexId m = mid(t, kRedEdge[e][0], kRedEdge[e][1]);
    for (const std::uint8_t end : kRedEdge[e]) {
      std::array<VertexId, 4> half = lattice_.reds[t].nodes;
      half[end] = m;
      add(t, half, 1);
    }
  }

  /// 1:4 by two opposite edges: each end of the one with each end of the other.
  void emit_opposite(std::size_t t, unsigned e) {
    const unsigned o = 5 - e;
    const VertexId m = mid(t, kRedEdge[e][0], kRedEdge[e][1]);
    const VertexId n = mid(t, kRedEdge[o][0], kRedEdge[o][1]);
    for (const std::uint8_t end : kRedEdge[e]) {
      for (const std::uint8_t other : kRedEdge[o]) {
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

/// What the closure asks of a red tet: the edges to be split in addition, or a red split.
struct RedGreenRefiner::Demand {
  std::uint8_t extra = 0;
  bool red = false;
  std::uint8_t split = 0;  ///< the edges that are split as it is
};

/// A demand that a red tet meets.
struct RedGreenRefiner::Action {
  std::uint32_t red = 0;
  std::uint8_t edges = 0;   ///< to be split
  bool splits = false;      ///< the tet itself
  bool is_changed = false;  ///< its split edges are others than before, and near_ is to know
};

RedGreenRefiner::Demand RedGreenRefiner::demand_of(const RedTet& red) const {
  const Pattern pattern = pattern_of(lattice_, red);
  const unsigned split = pattern.split;
  const auto as_it_is = static_cast<std::uint8_t>(split);
  if (split == 0) {
    return {};
  }
  if (pattern.too_deep) {
    return {0, true, as_it_is};
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
    return {static_cast<std::uint8_t>(closed & ~split), false, as_it_is};
  }
  return {0, true, as_it_is};
}

std::size_t RedGreenRefiner::refine(const std::vector<std::uint8_t>& marked) {
  split_count_ = 0;
  ++sweep_;
  act(collect<Action>(lattice_.reds.size(), 1, [&](std::size_t t, const auto& add) {
    if (marked[t] != 0 && lattice_.reds[t].level < lattice_.frame.max_level) {
      add({static_cast<std::uint32_t>(t), kAllEdges, true, false});
    }
  }));
  for (bool changed = split_count_ > 0; changed;) {
    ++sweep_;
    just_touched_.swap(touched_);
    touched_.clear();
    changed = sweep();
  }
  return split_count_;
}

bool RedGreenRefiner::is_concerned(const RedTet& red) const {
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
bool RedGreenRefiner::is_touched_inside(const RedTet& red, unsigned face) const {
  for (unsigned edges = face & (face - 1); edges != 0; edges &= edges - 1) {
    const auto e = static_cast<unsigned>(std::countr_zero(edges));
    const LatticePoint& a = lattice_.points[red.nodes[kRedEdge[e][0]]];
    const LatticePoint& b = lattice_.points[red.nodes[kRedEdge[e][1]]];
    if (last_touched_[lattice_.table.find(midpoint(a, b))] + 1 == sweep_) {
      return true;
    }
  }
  return false;
}

bool RedGreenRefiner::sweep() {
  const std::vector<std::uint32_t> concerned = concerned_reds();
  const std::vector<Action> actions =
      collect<Action>(concerned.size(), 1, [&](std::size_t c, const auto& add) {
        RedTet& red = lattice_.reds[concerned[c]];
        const Demand demand = demand_of(red);
        const bool is_changed = near_.is_built() && red.split != demand.split;
        red.split = demand.split;
        if (demand.red || demand.extra != 0 || is_changed) {
          add({concerned[c], demand.red ? kAllEdges : demand.extra, demand.red, is_changed});
        }
      });
  act(actions);
  return std::any_of(actions.begin(), actions.end(), [](const Action& action) { return action.edges != 0; });
}

/// Acts in order. Many actions are taken in parallel, with the outcome of the order.
void RedGreenRefiner::act(const std::vector<Action>& actions) {
  constexpr std::size_t kWorthThreads = 1024, kMostTogether = 4096;
  for (const Action& action : actions) {
    if (action.is_changed) {
      note_changed(action.red);
    }
  }
  if (actions.size() >= kWorthThreads && omp_get_max_threads() > 1) {
    for (std::span<const Action> left = actions; !left.empty();) {
      const std::size_t taken = std::min(left.size(), kMostTogether);
      act_together(left.first(taken));
      left = left.subspan(taken);
    }
    return;
  }
  for (const Action& action : actions) {
    if (action.splits) {
      split_red(action.red);
    } else {
      split_edges(lattice_.reds[action.red], action.edges);
    }
  }
}

/// A midpoint that several actions ask for, and nobody before, becomes the vertex of the first of them.
void RedGreenRefiner::act_together(std::span<const Action> actions) {
  const auto slots = std::make_unique_for_overwrite<std::uint32_t[]>(6 * actions.size());
  const auto known = static_cast<VertexId>(lattice_.points.size());
  lattice_.table.reserve(6 * actions.size());
#pragma omp parallel for schedule(static)
  for (std::size_t a = 0; a < actions.size(); ++a) {
    for_each_edge(actions[a].edges, [&](std::size_t e) {
      const LatticePoint middle = middle_point(lattice_, lattice_.reds[actions[a].red], e);
      slots[6 * a + e] = lattice_.table.claim(middle, static_cast<VertexId>(known + 6 * a + e));
    });
  }
  split_claimed_edges(actions, slots.get());
  split_claimed_reds(actions, slots.get());
}

/// Makes the vertices of the slots that were claimed; each slot still has the number it was claimed with.
void RedGreenRefiner::split_claimed_edges(std::span<const Action> actions, const std::uint32_t* slots) {
  VertexTable& table = lattice_.table;
  const std::size_t known = lattice_.points.size();
  const std::vector<std::uint32_t> won =
      collect<std::uint32_t>(actions.size(), 6, [&](std::size_t a, const auto& add) {
        for_each_edge(actions[a].edges, [&](std::size_t e) {
          if (table.vertex_in(slots[6 * a + e]) == known + 6 * a + e) {
            add(static_cast<std::uint32_t>(6 * a + e));
          }
        });
      });
  table.inserted(won.size());
  lattice_.points.resize(known + won.size());
  lattice_.split_below.resize(known + won.size(), 0);
  last_touched_.resize(known + won.size(), 0);
  const auto touched = collect<VertexId>(won.size(), 3, [&](std::size_t w, const auto& add) {
    const RedTet& red = lattice_.reds[actions[won[w] / 6].red];
    const std::size_t e = won[w] % 6;
    const auto vertex = static_cast<VertexId>(known + w);
    lattice_.points[vertex] = middle_point(lattice_, red, e);
    table.set_vertex(slots[won[w]], vertex);
    for (const VertexId v : {vertex, red.nodes[kRedEdge[e][0]], red.nodes[kRedEdge[e][1]]}) {
      if (v != vertex) {
        raise(lattice_.split_below[v], static_cast<std::int8_t>(red.level + 1));
      }
      if (is_first(last_touched_[v], sweep_)) {
        add(v);
      }
    }
  });
  touched_.insert(touched_.end(), touched.begin(), touched.end());
}

void RedGreenRefiner::split_claimed_reds(std::span<const Action> actions, const std::uint32_t* slots) {
  std::vector<std::size_t> others(actions.size() + 1, lattice_.reds.size());  // where further children go
  for (std::size_t a = 0; a < actions.size(); ++a) {
    others[a + 1] = others[a] + (actions[a].splits ? 7 : 0);
  }
  const std::size_t known = others[0];
  lattice_.reds.resize(others.back());
  const auto touched = collect<VertexId>(actions.size(), 6, [&](std::size_t a, const auto& add) {
    if (actions[a].splits) {
      std::array<VertexId, 6> middles;
      for (std::size_t e = 0; e < 6; ++e) {
        middles[e] = lattice_.table.vertex_in(slots[6 * a + e]);
        if (is_first(last_touched_[middles[e]], sweep_)) {
          add(middles[e]);
        }
      }
      write_children(actions[a].red, middles, others[a]);
    }
  });
  touched_.insert(touched_.end(), touched.begin(), touched.end());
  if (near_.is_built()) {
    std::for_each(actions.begin(), actions.end(), [this](const Action& action) {
      if (action.splits) note_changed(action.red);
    });
    for (std::size_t r = known; r < lattice_.reds.size(); ++r) {
      note_changed(r);
    }
  }
  split_count_ += (lattice_.reds.size() - known) / 7;
}

/// What the last sweep can have touched, ascending. Many sweeps touch little: then it is looked up.
std::vector<std::uint32_t> RedGreenRefiner::concerned_reds() {
  constexpr std::size_t kRedsOfAVertex = 32;
  constexpr int kWorthBuilding = 6;  // sweeps over all tets that cost as much as building
  const bool few = kRedsOfAVertex * just_touched_.size() < lattice_.reds.size();
  if (near_.is_built() && near_.is_stale()) {
    near_.drop();
    small_sweeps_ = 0;
  }
  if (few && !near_.is_built() && ++small_sweeps_ > kWorthBuilding) {
    near_.build(lattice_);
  }
  if (!few || !near_.is_built()) {
    return indices_where(lattice_.reds.size(), [&](std::size_t t) { return is_concerned(lattice_.reds[t]); });
  }
  return concerned_near(just_touched_);
}

/// Of the red tets that near_ has for these vertices, those that are concerned. A bit of each says which
/// were found already, and brings them in order.
std::vector<std::uint32_t> RedGreenRefiner::concerned_near(const std::vector<VertexId>& vertices) const {
  constexpr std::size_t kWorthThreads = 256;
  std::vector<std::uint64_t> found((lattice_.reds.size() + 63) / 64, 0);
#pragma omp parallel for schedule(dynamic, 64) if (vertices.size() > kWorthThreads)
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    near_.for_each_near(vertices[v], [&](std::uint32_t t) {
      const std::atomic_ref<std::uint64_t> word(found[t / 64]);
      const std::uint64_t bit = std::uint64_t{1} << (t % 64);
      if ((word.load(std::memory_order_relaxed) & bit) == 0 && is_concerned(lattice_.reds[t])) {
        word.fetch_or(bit, std::memory_order_relaxed);
      }
    });
  }
  std::vector<std::uint32_t> concerned;
  for (std::size_t word = 0; word < found.size(); ++word) {
    for (std::uint64_t left = found[word]; left != 0; left &= left - 1) {
      concerned.push_back(static_cast<std::uint32_t>(64 * word) +
                          static_cast<std::uint32_t>(std::countr_zero(left)));
    }
  }
  return concerned;
}

void RedGreenRefiner::note_changed(std::size_t red) {
  if (near_.is_built()) {
    near_.note_changed(lattice_, red);
  }
}

void RedGreenRefiner::touch(VertexId v) {
  if (last_touched_[v] != sweep_) {
    last_touched_[v] = sweep_;
    touched_.push_back(v);
  }
}

VertexId RedGreenRefiner::split_edge(VertexId a, VertexId b, int level) {
  const std::size_t before = lattice_.points.size();
  const VertexId middle = lattice_.vertex_at(midpoint(lattice_.points[a], lattice_.points[b]));
  if (middle == before) {
    last_touched_.push_back(0);
    touch(middle);
    for (const VertexId end : {a, b}) {
      touch(end);
      std::int8_t& below = lattice_.split_below[end];
      below = std::max(below, static_cast<std::int8_t>(level + 1));
    }
  }
  return middle;
}

void RedGreenRefiner::split_edges(const RedTet& red, unsigned edges) {
  for_each_edge(edges, [&](std::size_t e) {
    split_edge(red.nodes[kRedEdge[e][0]], red.nodes[kRedEdge[e][1]], red.level);
  });
}

/// Splits the tet at `index` in eight. All children have a midpoint among their nodes, which is touched, so
/// the next sweep looks at them.
void RedGreenRefiner::split_red(std::size_t index) {
  const RedTet red = lattice_.reds[index];
  std::array<VertexId, 6> middles;
  for (unsigned e = 0; e < 6; ++e) {
    middles[e] = split_edge(red.nodes[kRedEdge[e][0]], red.nodes[kRedEdge[e][1]], red.level);
    touch(middles[e]);
  }
  const std::size_t others = lattice_.reds.size();
  lattice_.reds.resize(others + 7);
  write_children(index, middles, others);
  note_changed(index);
  for (std::size_t r = others; r < others + 7; ++r) {
    note_changed(r);
  }
  ++split_count_;
}

/// The first child takes its parent's place, the others go to `others` and what follows.
void RedGreenRefiner::write_children(std::size_t index, const std::array<VertexId, 6>& middles,
                                     std::size_t others) {
  const RedTet red = lattice_.reds[index];
  const auto& [a, b, c, d] = red.nodes;
  const auto& [ab, ac, ad, bc, bd, cd] = middles;
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
    lattice_.reds[others + n - 1] = {children[n], level, 0};
  }
}

std::size_t refine_red_green(Lattice& lattice, const std::vector<std::uint8_t>& marked) {
  return RedGreenRefiner(lattice).refine(marked);
}

std::uint32_t piece_count(const RedTet& red) {
  const unsigned all_but_one = red.split & (red.split - 1U);
  return 1U << ((red.split != 0 ? 1U : 0U) + (all_but_one != 0 ? 1U : 0U));  // without a jump
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

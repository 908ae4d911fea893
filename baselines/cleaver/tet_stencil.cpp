#include "baselines/cleaver/tet_stencil.hpp"

#include <algorithm>

#include "baselines/cleaver/tet_angles.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// Quads are put inside a tet when no point of its surface gives angles above this one: cos 8 degrees.
constexpr double kPoorCosine = 0.99027;

std::uint8_t edge_point(std::size_t edge) {
  return static_cast<std::uint8_t>(4 + edge);
}

std::uint8_t point_of_cut(const CutLattice& cut, const MixedTet& mixed, const std::array<VertexId, 4>& nodes,
                          std::size_t edge) {
  const std::uint8_t a = kTetEdge[edge][0], b = kTetEdge[edge][1];
  const std::uint8_t first = nodes[a] < nodes[b] ? a : b;
  const std::uint8_t second = nodes[a] < nodes[b] ? b : a;
  const std::uint32_t c = mixed.cuts[edge];
  if (c == kNone || cut.cuts[c].place == CutPlace::kAtFirst) return first;
  return cut.cuts[c].place == CutPlace::kAtSecond ? second : edge_point(edge);
}

// The corner of a face with the lowest vertex.
std::uint8_t lowest_corner(const std::array<VertexId, 4>& nodes, const std::array<std::uint8_t, 3>& face) {
  return *std::min_element(face.begin(), face.end(), [&](auto a, auto b) { return nodes[a] < nodes[b]; });
}

// Of two cuts within a face, the one on the edge of the lower end of the third edge.
std::uint8_t diagonal_cut(const TetState& state, const std::array<std::uint8_t, 3>& face) {
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint8_t v = face[n], w = face[(n + 1) % 3], x = face[(n + 2) % 3];
    if (state.cut_at[kEdgeBetween[v][w]] >= 4) continue;
    const std::uint8_t lower = state.nodes[v] < state.nodes[w] ? v : w;
    return state.cut_at[kEdgeBetween[lower][x]];
  }
  return face[0];
}

std::uint8_t point_of_triple(const CutLattice& cut, const MixedTet& mixed, const TetState& state,
                             std::size_t face_number) {
  const auto& face = kTetFace[face_number];
  int within = 0;
  std::uint8_t only = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint8_t at = state.cut_at[kEdgeBetween[face[n]][face[(n + 1) % 3]]];
    if (at < 4) continue;
    ++within;
    only = at;
  }
  if (within == 0) return lowest_corner(state.nodes, face);
  if (within == 1) return only;
  const std::uint32_t t = mixed.triples[face_number];
  if (t == kNone) return diagonal_cut(state, face);
  const std::uint32_t snapped = cut.triples[t].snapped_to;
  if (snapped == kNone) return static_cast<std::uint8_t>(10 + face_number);
  return edge_point(static_cast<std::size_t>(std::find(mixed.cuts.begin(), mixed.cuts.end(), snapped) -
                                             mixed.cuts.begin()));
}

// A triangle of a face's subdivision, of the material of a corner, counter-clockwise seen from inside.
struct Flag {
  std::array<std::uint8_t, 3> points;
  std::uint8_t corner;
  std::uint8_t edge;
  std::uint8_t face;

  [[nodiscard]] bool has(std::uint8_t p) const { return points[0] == p || points[1] == p || points[2] == p; }
};

struct Flags {
  std::array<Flag, 24> flags;
  std::size_t count = 0;

  void add(std::uint8_t corner, std::uint8_t b, std::uint8_t c, std::uint8_t edge, std::size_t face) {
    if (corner == b || corner == c || b == c) return;
    flags[count++] = {{corner, b, c}, corner, edge, static_cast<std::uint8_t>(face)};
  }
};

Flags flags_of(const TetState& state) {
  Flags all;
  for (std::size_t f = 0; f < 4; ++f) {
    const std::uint8_t triple = state.triple_at[f];
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint8_t v = kTetFace[f][n], w = kTetFace[f][(n + 1) % 3];
      const std::uint8_t edge = kEdgeBetween[v][w];
      const std::uint8_t cut = state.cut_at[edge];
      all.add(v, cut, triple, edge, f);
      all.add(w, triple, cut, edge, f);
    }
  }
  return all;
}

bool lies_on_face(std::uint8_t point, std::size_t face) {
  if (point < 4) return point != face;
  if (point < 10) return kTetEdge[point - 4][0] != face && kTetEdge[point - 4][1] != face;
  return point == 10 + face;
}

// A point can be the quad when each flag of the faces it lies on has it.
bool can_be_quad(const Flags& flags, std::uint8_t point) {
  return std::all_of(flags.flags.begin(), flags.flags.begin() + flags.count,
                     [&](const Flag& flag) { return !lies_on_face(point, flag.face) || flag.has(point); });
}

double worst_with_quad(const TetState& state, const Flags& flags, std::uint8_t quad, double enough) {
  double worst = -2;
  for (std::size_t n = 0; n < flags.count && worst < enough; ++n) {
    const Flag& flag = flags.flags[n];
    if (flag.has(quad)) continue;
    worst = std::max(worst, worst_cosine({state.places[flag.points[0]], state.places[flag.points[1]],
                                          state.places[flag.points[2]], state.places[quad]}));
  }
  return worst;
}

// The mean of the points on the tet's surface: they surround it.
Vec3 inner_place(const TetState& state, const Flags& flags) {
  std::array<bool, kQuad> in_use{};
  for (std::size_t n = 0; n < flags.count; ++n) {
    for (const std::uint8_t p : flags.flags[n].points) in_use[p] = true;
  }
  Vec3 triples{}, all{};
  int triple_count = 0, count = 0;
  for (std::uint8_t p = 0; p < kQuad; ++p) {
    if (!in_use[p]) continue;
    all += state.places[p];
    ++count;
    if (p >= 10) triples += state.places[p], ++triple_count;
  }
  // With four triples the quad is amid them; otherwise amid everything.
  return triple_count == 4 ? triples / 4 : all / count;
}

std::uint8_t best_quad(TetState& state, const Flags& flags) {
  std::uint8_t best = kQuad;
  double least = 3;
  std::array<bool, kQuad> tried{};
  for (std::size_t n = 0; n < flags.count; ++n) {
    for (const std::uint8_t p : flags.flags[n].points) {
      if (tried[p]) continue;
      tried[p] = true;
      if (!can_be_quad(flags, p)) continue;
      const double worst = worst_with_quad(state, flags, p, least);
      if (worst < least) {
        least = worst;
        best = p;
      }
    }
  }
  if (best != kQuad && least < kPoorCosine) return best;
  state.places[kQuad] = inner_place(state, flags);
  return worst_with_quad(state, flags, kQuad, least) < least ? kQuad : best;
}

}  // namespace

TetState state_of(const CutLattice& cut, const MixedTet& mixed) {
  TetState state;
  state.nodes = cut.lattice.tets[mixed.tet];
  for (std::size_t n = 0; n < 4; ++n) state.places[n] = cut.lattice.points[state.nodes[n]];
  for (std::size_t e = 0; e < 6; ++e) {
    state.cut_at[e] = point_of_cut(cut, mixed, state.nodes, e);
    if (state.cut_at[e] >= 4) state.places[4 + e] = cut.place_of(cut.cuts[mixed.cuts[e]]);
  }
  for (std::size_t f = 0; f < 4; ++f) {
    state.triple_at[f] = point_of_triple(cut, mixed, state, f);
    if (state.triple_at[f] >= 10) state.places[10 + f] = cut.triples[mixed.triples[f]].place;
  }
  return state;
}

TetPieces pieces_of(const TetState& given) {
  TetState state = given;
  const Flags flags = flags_of(state);
  const std::uint8_t quad = best_quad(state, flags);
  TetPieces pieces;
  pieces.uses_quad = quad == kQuad;
  pieces.quad_place = state.places[kQuad];
  for (std::size_t n = 0; n < flags.count; ++n) {
    const Flag& flag = flags.flags[n];
    if (flag.has(quad)) continue;
    pieces.pieces[pieces.count++] = {
        {flag.points[0], flag.points[1], flag.points[2], quad}, flag.corner, flag.edge};
  }
  return pieces;
}

}  // namespace cbc3d::baselines::cleaver

// Red-green subdivision of the lattice (paper, figure "Red-Green templates for lattice subdivision").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/vertex_to_red_tets.hpp"

namespace cbc3d {

/// Refines a lattice in rounds. The closure of a round is made in sweeps. A sweep first reads, in parallel
/// and without changing anything, the red tets that the sweep before can have touched; then it acts in their
/// order. A new midpoint on the edge a-b concerns the tets that have this edge, the tets that have it as half
/// of an edge (a or b is one of their nodes), and the tets that have it as the inner segment of a face all of
/// whose edges are split. Each vertex therefore carries the number of the sweep that last split an edge at
/// it.
class RedGreenRefiner {
 public:
  /// `lattice` must outlive this, and nothing else may change it.
  explicit RedGreenRefiner(Lattice& lattice) : lattice_(lattice), last_touched_(lattice.points.size(), 0) {}

  /// Splits the marked red tets 1:8 (inner diagonal: the shortest, so that the children are congruent to the
  /// parent) and then every red tet that the green templates cannot close, until the whole is conforming:
  ///   no edge split: stays;  one edge: 1:2;  two opposite edges: 1:4;  the three edges of a face: 1:4;
  ///   two edges of one face: the third edge of that face is split too;  all else: red.
  /// `marked` has one entry per red tet; tets at the deepest level are never split, marked or not: the
  /// closure never needs that, because a neighbour can be at most as deep. Returns the number of red tets
  /// that were split.
  std::size_t refine(const std::vector<std::uint8_t>& marked);

 private:
  struct Demand;
  struct Action;
  bool sweep();
  [[nodiscard]] std::vector<std::uint32_t> concerned_reds();
  [[nodiscard]] std::vector<std::uint32_t> concerned_near(const std::vector<VertexId>& vertices) const;
  [[nodiscard]] bool is_concerned(const RedTet& red) const;
  [[nodiscard]] bool is_touched_inside(const RedTet& red, unsigned face) const;
  [[nodiscard]] Demand demand_of(const RedTet& red) const;
  void act(const std::vector<Action>& actions);
  void act_together(std::span<const Action> actions);
  void split_claimed_edges(std::span<const Action> actions, const std::uint32_t* slots);
  void split_claimed_reds(std::span<const Action> actions, const std::uint32_t* slots);
  void write_children(std::size_t index, const std::array<VertexId, 6>& middles, std::size_t others);
  void note_changed(std::size_t red);
  void touch(VertexId v);
  VertexId split_edge(VertexId a, VertexId b, int level);
  void split_edges(const RedTet& red, unsigned edges);
  void split_red(std::size_t index);

  Lattice& lattice_;
  std::vector<std::uint32_t> last_touched_;       // per vertex
  std::vector<VertexId> touched_, just_touched_;  // by this sweep and by the last one
  VertexToRedTets near_;
  int small_sweeps_ = 0;  // since near_ was dropped
  std::uint32_t sweep_ = 0;
  std::size_t split_count_ = 0;
};

/// One round, see RedGreenRefiner.
std::size_t refine_red_green(Lattice& lattice, const std::vector<std::uint8_t>& marked);

/// How many tets of the conforming mesh a red tet is: itself, or 2 or 4 green pieces.
std::uint32_t piece_count(const RedTet& red);

/// Writes the tets of red tet `red` to their places in `tets`, from `first` on.
void write_pieces(const Lattice& lattice, std::size_t red, std::size_t first, LatticeTets& tets);

/// The conforming mesh of the lattice as it stands: red leaves and green pieces, in the order of the red
/// tets.
LatticeTets extract_tets(const Lattice& lattice);

}  // namespace cbc3d

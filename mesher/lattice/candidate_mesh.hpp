// The candidate mesh, and how it follows a lattice that is being refined.
//
// A late round of the refinement splits few tets out of a million. What the others have (nodes, neighbours,
// and whatever the caller has computed for them) stays, under new numbers: tets are numbered in the order of
// their red tets, so a red tet that was split moves all that come after it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_voxels.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// The conforming lattice with a material for every tet (background ones included) and who neighbours whom.
struct CandidateMesh {
  LatticeTets tets;
  std::vector<MaterialId> materials;
  TetNeighbours neighbours;
  /// 0 for a vertex at which every label's surface is known to be a manifold; empty: nothing is known.
  std::vector<std::uint8_t> unsure = {};

  /// True where a tet of another material is across one of the faces.
  [[nodiscard]] bool is_at_interface(std::size_t t) const {
    return std::any_of(neighbours[t].begin(), neighbours[t].end(),
                       [&](TetId across) { return across != kNoTet && materials[across] != materials[t]; });
  }
};

/// Where the tets of each red tet are, and what becomes of them when the lattice changes.
class LatticeFollower {
 public:
  /// `lattice` must outlive this.
  explicit LatticeFollower(const Lattice& lattice) : lattice_(lattice) {}

  /// Compares the lattice with what it was at the last call; returns the new number of every tet there was,
  /// kNoTet for those that are gone because their red tet was split or its green pieces are others.
  UninitializedVector<TetId> renumber();

  /// Brings nodes and neighbours up to date, for what renumber() returned. Parallel. What is kept is not
  /// computed again. The materials are the caller's.
  void rebuild(CandidateMesh& mesh, const UninitializedVector<TetId>& number) const;

  /// The tets of red tet r are first(r) ... first(r + 1) - 1.
  [[nodiscard]] TetId first(std::size_t r) const { return first_[r]; }
  [[nodiscard]] std::size_t tet_count() const { return first_.empty() ? 0 : first_.back(); }

 private:
  /// What distinguishes a red tet from the one that had its place before: splitting it makes it one level
  /// deeper.
  struct Shape {
    std::int8_t level;
    std::uint8_t split;
    bool operator==(const Shape&) const = default;
  };

  static constexpr std::size_t kRedsOfBlock = 4096;
  [[nodiscard]] std::vector<TetId> first_of_blocks() const;

  const Lattice& lattice_;
  UninitializedVector<TetId> first_;
  UninitializedVector<Shape> shapes_;
  std::vector<std::uint8_t> is_new_;  // a red tet whose tets are to be written
};

/// Values of the tets under their new numbers; `otherwise` for the tets that are new.
template <typename Values, typename T = typename Values::value_type>
Values renumbered(const Values& values, const UninitializedVector<TetId>& number, std::size_t count,
                  T otherwise) {
  Values result(count);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < count; ++t) {
    result[t] = otherwise;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < values.size(); ++t) {
    if (number[t] != kNoTet) {
      result[number[t]] = values[t];
    }
  }
  return result;
}

}  // namespace cbc3d

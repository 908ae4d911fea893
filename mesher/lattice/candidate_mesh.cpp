#include "mesher/lattice/candidate_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesher/lattice/red_green.hpp"

namespace cbc3d {
namespace {

/// The tets that are kept, at their new places.
LatticeTets keep_tets(const LatticeTets& old, const UninitializedVector<TetId>& number, std::size_t count) {
  LatticeTets tets;
  tets.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (number[t] != kNoTet) {
      tets.nodes[number[t]] = old.nodes[t];
      tets.parent[number[t]] = old.parent[t];
      tets.green[number[t]] = old.green[t];
    }
  }
  return tets;
}

/// Neighbours of the tets that are kept, unknown where the neighbour is gone.
TetNeighbours keep_neighbours(const TetNeighbours& old, const UninitializedVector<TetId>& number,
                              std::size_t count) {
  TetNeighbours neighbours(count);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < count; ++t) {
    neighbours[t].fill(kUnknownTet);
  }
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < number.size(); ++t) {
    for (std::size_t n = 0; n < 4 && number[t] != kNoTet; ++n) {
      const TetId across = old[t][n];
      if (across == kNoTet || number[across] != kNoTet) {
        neighbours[number[t]][n] = across == kNoTet ? kNoTet : number[across];
      }
    }
  }
  return neighbours;
}

}  // namespace

/// Where the numbers of each block of kRedsOfBlock red tets begin, and at last how many there are.
std::vector<TetId> LatticeFollower::first_of_blocks() const {
  const UninitializedVector<RedTet>& reds = lattice_.reds;
  std::vector<TetId> first((reds.size() + kRedsOfBlock - 1) / kRedsOfBlock + 1, 0);
#pragma omp parallel for schedule(static) if (first.size() > 2)
  for (std::size_t b = 1; b < first.size(); ++b) {
    TetId pieces = 0;
    for (std::size_t r = (b - 1) * kRedsOfBlock; r < std::min(reds.size(), b * kRedsOfBlock); ++r) {
      pieces += piece_count(reds[r]);
    }
    first[b] = pieces;
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

UninitializedVector<TetId> LatticeFollower::renumber() {
  UninitializedVector<TetId> number(tet_count());
  const std::vector<TetId> first = first_of_blocks();
  const UninitializedVector<TetId> before = std::exchange(first_, {});
  const std::size_t count = lattice_.reds.size(), known = shapes_.size();
  first_.resize(count + 1);
  shapes_.resize(count);
  is_new_.assign(count, 1);
#pragma omp parallel for schedule(static) if (first.size() > 2)
  for (std::size_t b = 1; b < first.size(); ++b) {
    TetId next = first[b - 1];
    for (std::size_t r = (b - 1) * kRedsOfBlock; r < std::min(count, b * kRedsOfBlock); ++r) {
      const RedTet& red = lattice_.reds[r];
      const Shape shape = {red.level, red.split};
      if (r < known && shapes_[r] == shape) {
        is_new_[r] = 0;
        for (TetId t = before[r]; t < before[r + 1]; ++t) {
          number[t] = next + (t - before[r]);
        }
      } else if (r < known) {
        std::fill(number.begin() + before[r], number.begin() + before[r + 1], kNoTet);
      }
      shapes_[r] = shape;
      first_[r] = next;
      next += piece_count(red);
    }
  }
  first_.back() = first.back();
  return number;
}

void LatticeFollower::rebuild(CandidateMesh& mesh, const UninitializedVector<TetId>& number) const {
  mesh.tets = keep_tets(mesh.tets, number, tet_count());
#pragma omp parallel for schedule(dynamic, 4096)
  for (std::size_t r = 0; r < is_new_.size(); ++r) {
    if (is_new_[r] != 0) {
      write_pieces(lattice_, r, first_[r], mesh.tets);
    }
  }
  mesh.neighbours = keep_neighbours(mesh.neighbours, number, tet_count());
  find_unknown_neighbours(mesh.tets.nodes, lattice_.points.size(), mesh.neighbours);
}

}  // namespace cbc3d

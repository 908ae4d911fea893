#include "mesher/stages/candidate_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesher/stages/red_green.hpp"

namespace cbc3d {
namespace {

/// The tets that are kept, at their new places.
LatticeTets keep_tets(const LatticeTets& old, const std::vector<TetId>& number, std::size_t count) {
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
std::vector<std::array<TetId, 4>> keep_neighbours(const std::vector<std::array<TetId, 4>>& old,
                                                  const std::vector<TetId>& number, std::size_t count) {
  std::vector<std::array<TetId, 4>> neighbours(count, {kUnknownTet, kUnknownTet, kUnknownTet, kUnknownTet});
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

/// The number of the first tet of each red tet, and at last how many there are. Parallel, block by block.
void LatticeFollower::number_pieces() {
  constexpr std::size_t kReds = 4096;
  const std::vector<RedTet>& reds = lattice_.reds;
  const std::size_t blocks = (reds.size() + kReds - 1) / kReds;
  std::vector<TetId> next(blocks + 1, 0);
  first_.resize(reds.size() + 1);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b) {
    for (std::size_t r = b * kReds; r < std::min(reds.size(), (b + 1) * kReds); ++r) {
      next[b + 1] += piece_count(reds[r]);
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b) {
    TetId tet = next[b];
    for (std::size_t r = b * kReds; r < std::min(reds.size(), (b + 1) * kReds); ++r) {
      first_[r] = tet;
      tet += piece_count(reds[r]);
    }
  }
  first_.back() = next.back();
}

std::vector<TetId> LatticeFollower::renumber() {
  const std::vector<RedTet>& reds = lattice_.reds;
  std::vector<TetId> number(tet_count(), kNoTet);
  const std::vector<TetId> before = std::exchange(first_, {});
  number_pieces();
  const std::size_t known = shapes_.size();
  shapes_.resize(reds.size());
  is_new_.assign(reds.size(), 1);
#pragma omp parallel for schedule(static, 4096)
  for (std::size_t r = 0; r < reds.size(); ++r) {
    const Shape shape = {reds[r].level, reds[r].split};
    if (r < known && shapes_[r] == shape) {
      is_new_[r] = 0;
      std::iota(number.begin() + before[r], number.begin() + before[r + 1], first_[r]);
    }
    shapes_[r] = shape;
  }
  return number;
}

void LatticeFollower::rebuild(CandidateMesh& mesh, const std::vector<TetId>& number) const {
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

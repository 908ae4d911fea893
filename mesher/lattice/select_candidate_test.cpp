// The selection of the candidate mesh, against its rules written down tet by tet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/select_candidate.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/testing/thread_counts.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using testing::at_thread_counts;
using testing::refined_lattice;

/// The rules of the selection (select_candidate.hpp), written down tet by tet in order.
class SelectionInOrder {
 public:
  SelectionInOrder(const TetNeighbours& neighbours, const std::vector<std::uint32_t>& rank,
                   std::vector<MaterialId> materials)
      : neighbours_(neighbours), rank_(rank), materials_(std::move(materials)) {}

  std::vector<MaterialId> run() {
    const std::vector<MaterialId> before = materials_;
    for (TetId t = 0; t < before.size(); ++t) {
      materials_[t] = before[t] == kBackground ? filled(t, before) : before[t];
    }
    std::vector<std::uint8_t> next(materials_.size(), 1);
    for (bool any = true; any;) {
      any = false;
      const std::vector<std::uint8_t> now = std::exchange(next, std::vector<std::uint8_t>(next.size(), 0));
      for (TetId t = 0; t < now.size(); ++t) {
        const MaterialId wanted = now[t] != 0 ? wanted_of(t) : materials_[t];
        if (wanted != materials_[t]) {
          materials_[t] = wanted;
          any = true;
          next[t] = 1;
          for (const TetId n : neighbours_[t]) {
            if (n != kNoTet) next[n] = 1;
          }
        }
      }
    }
    return materials_;
  }

 private:
  [[nodiscard]] std::array<MaterialId, 4> around(TetId t, const std::vector<MaterialId>& materials) const {
    std::array<MaterialId, 4> around{};
    for (std::size_t n = 0; n < 4; ++n) {
      around[n] = neighbours_[t][n] == kNoTet ? kBackground : materials[neighbours_[t][n]];
    }
    return around;
  }

  [[nodiscard]] MaterialId filled(TetId t, const std::vector<MaterialId>& before) const {
    const auto a = around(t, before);
    MaterialId best = kBackground;
    for (const MaterialId m : a) {
      const auto more = std::count(a.begin(), a.end(), m) - std::count(a.begin(), a.end(), best);
      if (m != kBackground && (best == kBackground || more > 0 || (more == 0 && rank_[m] > rank_[best]))) {
        best = m;
      }
    }
    return std::count(a.begin(), a.end(), kBackground) > 2 ? kBackground : best;
  }

  [[nodiscard]] MaterialId wanted_of(TetId t) const {
    const auto a = around(t, materials_);
    const auto faces = [&](MaterialId m) { return std::count(a.begin(), a.end(), m); };
    const MaterialId own = materials_[t];
    MaterialId best = own;
    if (own != kBackground && faces(kBackground) >= 2) {
      return kBackground;
    }
    for (const MaterialId m : a) {
      if (faces(m) > faces(best) || (faces(m) == faces(best) && faces(m) >= 2 && rank_[m] > rank_[best])) {
        best = m;
      }
    }
    return best;
  }

  const TetNeighbours& neighbours_;
  const std::vector<std::uint32_t>& rank_;
  std::vector<MaterialId> materials_;
};

TEST(SelectCandidate, SelectionIsThatOfTheOrder) {
  const Lattice lattice = refined_lattice();
  const LatticeTets tets = extract_tets(lattice);
  const TetNeighbours neighbours = tet_neighbours(tets.nodes, lattice.points.size());
  const std::vector<std::uint32_t> rank = {3, 1, 2, 0};
  std::mt19937 random(11);
  for (const std::uint32_t noise : {0U, 10U, 60U, 100U}) {
    std::vector<MaterialId> asked(tets.size());
    for (std::size_t t = 0; t < tets.size(); ++t) {
      const LatticePoint& p = lattice.points[tets.nodes[t][0]];
      asked[t] =
          static_cast<MaterialId>(random() % 100 < noise ? random() % 4 : (p[0] / 200 + p[1] / 150) % 4);
    }
    const std::vector<MaterialId> wanted = SelectionInOrder(neighbours, rank, asked).run();
    EXPECT_NE(wanted, asked);
    at_thread_counts([&] {
      std::vector<MaterialId> materials = asked;
      EXPECT_GT(select_candidate(neighbours, rank, materials), 0U);
      EXPECT_EQ(materials, wanted) << noise << " % noise";
    });
  }
}

}  // namespace
}  // namespace cbc3d

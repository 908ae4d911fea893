// What the refinement does in parallel: the outcome is that of one thread, in order.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/select_candidate.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using testing::at_thread_counts;

/// Rounds in which many tets split at once, and then few.
Lattice refined_lattice() {
  Lattice lattice = build_bcc_lattice(testing::ball_image(40, 1, 17), {3, 0.3});
  RedGreenRefiner refiner(lattice);
  std::mt19937 random(7);
  for (const std::uint32_t one_in : {4U, 40U, 4000U}) {
    std::vector<std::uint8_t> marked(lattice.reds.size());
    std::generate(marked.begin(), marked.end(),
                  [&] { return static_cast<std::uint8_t>(random() % one_in == 0); });
    refiner.refine(marked);
  }
  return lattice;
}

TEST(RefinementThreads, SplitsManyTetsAtOnceAsOneAfterTheOther) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Lattice wanted = refined_lattice();
  omp_set_num_threads(before);
  ASSERT_GT(wanted.reds.size(), 50000U);
  at_thread_counts([&] {
    const Lattice lattice = refined_lattice();
    testing::expect_same_lattice(lattice, wanted);
    for (std::size_t v = 0; v < wanted.points.size(); ++v) {
      ASSERT_EQ(lattice.table.find(wanted.points[v]), v);
    }
  });
}

TEST(RefinementThreads, NeighboursAreTheTetsWithTheSameFace) {
  const Lattice lattice = refined_lattice();
  LatticeTets tets = extract_tets(lattice);
  std::map<std::array<VertexId, 3>, std::vector<TetId>> of_face;
  const auto face_of = [&](TetId t, std::size_t n) {
    std::array<VertexId, 3> face;
    for (std::size_t c = 0; c < 3; ++c) {
      face[c] = tets.nodes[t][kTetFace[n][c]];
    }
    std::sort(face.begin(), face.end());
    return face;
  };
  TetNeighbours wanted(tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  for (TetId t = 0; t < tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      of_face[face_of(t, n)].push_back(t);
    }
  }
  for (TetId t = 0; t < tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      for (const TetId other : of_face[face_of(t, n)]) {
        wanted[t][n] = other == t ? wanted[t][n] : other;
      }
    }
  }
  at_thread_counts([&] {
    EXPECT_EQ(tet_neighbours(tets.nodes, lattice.points.size()), wanted);
    TetNeighbours partly = wanted;  // what is known stays, what is not is found
    for (std::size_t t = 0; t < partly.size(); t += 5) {
      partly[t] = {kUnknownTet, kUnknownTet, kUnknownTet, kUnknownTet};
      for (std::size_t n = 0; n < 4; ++n) {
        if (wanted[t][n] != kNoTet) {
          auto& back = partly[wanted[t][n]];
          std::replace(back.begin(), back.end(), static_cast<TetId>(t), kUnknownTet);
        }
      }
    }
    find_unknown_neighbours(tets.nodes, lattice.points.size(), partly);
    EXPECT_EQ(partly, wanted);
  });
  tets.nodes.push_back(tets.nodes[tets.size() / 2]);
  at_thread_counts([&] { EXPECT_THROW(tet_neighbours(tets.nodes, lattice.points.size()), JobError); });
  EXPECT_TRUE(tet_neighbours({}, 0).empty());
}

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

TEST(RefinementThreads, SelectionIsThatOfTheOrder) {
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

// Neighbours and stars of tets, against a table of all faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/thread_counts.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using testing::at_thread_counts;

constexpr int kCubes = 22;
constexpr std::size_t kVertices = 23 * 23 * 23;

/// Enough tets for every pass to be cut into several pieces, in no order.
TetNodes shuffled_box() {
  TetNodes tets = testing::KuhnBox(kCubes).tets;
  std::mt19937 random(7);
  for (std::size_t t = tets.size(); t > 1; --t) std::swap(tets[t - 1], tets[random() % t]);
  return tets;
}

TEST(TetAdjacency, NeighboursAreTheTetsWithTheSameFace) {
  TetNodes tets = shuffled_box();
  const std::size_t vertex_count = kVertices;
  std::map<std::array<VertexId, 3>, std::vector<TetId>> of_face;
  const auto face_of = [&](TetId t, std::size_t n) {
    std::array<VertexId, 3> face;
    for (std::size_t c = 0; c < 3; ++c) {
      face[c] = tets[t][kTetFace[n][c]];
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
    EXPECT_EQ(tet_neighbours(tets, vertex_count), wanted);
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
    find_unknown_neighbours(tets, vertex_count, partly);
    EXPECT_EQ(partly, wanted);
  });
  tets.push_back(tets[tets.size() / 2]);
  at_thread_counts([&] { EXPECT_THROW(tet_neighbours(tets, vertex_count), JobError); });
  EXPECT_TRUE(tet_neighbours({}, 0).empty());
}

TEST(TetAdjacency, StarsAreTheTetsWithTheVertex) {
  const TetNodes tets = shuffled_box();
  std::vector<std::vector<TetId>> wanted(kVertices);
  for (TetId t = 0; t < tets.size(); ++t) {
    for (const VertexId v : tets[t]) wanted[v].push_back(t);
  }
  at_thread_counts([&] {
    const VertexCells around = tets_of_vertices(tets, kVertices);
    ASSERT_EQ(around.first.size(), kVertices + 1);
    for (std::size_t v = 0; v < kVertices; ++v) {
      EXPECT_EQ(std::vector<TetId>(around.cells.begin() + around.first[v],
                                   around.cells.begin() + around.first[v + 1]),
                wanted[v]);
    }
  });
}

}  // namespace
}  // namespace cbc3d

// Which red tets a vertex concerns, against a search through all of them.
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/lattice/vertex_to_red_tets.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

using Reds = std::vector<std::set<std::uint32_t>>;

/// The red tets that each vertex is a node of, or the middle of a split edge.
Reds by_search(const Lattice& lattice) {
  Reds reds(lattice.points.size());
  for (std::uint32_t r = 0; r < lattice.reds.size(); ++r) {
    const RedTet& red = lattice.reds[r];
    for (const VertexId v : red.nodes) reds[v].insert(r);
    for (std::size_t e = 0; e < 6; ++e) {
      if ((red.split >> e & 1) != 0) {
        reds[lattice.table.find(midpoint(lattice.points[red.nodes[kRedEdge[e][0]]],
                                         lattice.points[red.nodes[kRedEdge[e][1]]]))]
            .insert(r);
      }
    }
  }
  return reds;
}

std::set<std::uint32_t> found_at(const VertexToRedTets& near, VertexId v) {
  std::set<std::uint32_t> found;
  near.for_each_near(v, [&](std::uint32_t r) { found.insert(r); });
  return found;
}

TEST(VertexToRedTets, AreAllOfAVertexAndKeepUpWithChanges) {
  Lattice lattice = build_bcc_lattice(testing::ball_image(24, 1, 9), {6, 0.5});
  testing::refine_at_random(lattice, 2, 5, 8);
  VertexToRedTets near;
  EXPECT_FALSE(near.is_built());
  const Reds wanted = by_search(lattice);
  testing::at_thread_counts([&] {
    near.build(lattice);
    EXPECT_TRUE(near.is_built());
    for (VertexId v = 0; v < wanted.size(); ++v) ASSERT_EQ(found_at(near, v), wanted[v]);
  });
  const auto before = lattice.reds;
  testing::refine_at_random(lattice, 1, 6, 20);
  for (std::size_t r = 0; r < lattice.reds.size(); ++r) {
    if (r >= before.size() || lattice.reds[r].nodes != before[r].nodes ||
        lattice.reds[r].split != before[r].split) {
      near.note_changed(lattice, r);
    }
  }
  const Reds changed = by_search(lattice);
  for (VertexId v = 0; v < changed.size(); ++v) {
    const auto found = found_at(near, v);  // and maybe some that no longer are
    ASSERT_TRUE(std::includes(found.begin(), found.end(), changed[v].begin(), changed[v].end())) << v;
  }
  for (int twice = 0; twice < 2; ++twice) {
    for (std::size_t r = 0; r < lattice.reds.size(); ++r) near.note_changed(lattice, r);
  }
  EXPECT_TRUE(near.is_stale());  // most of what is known came later
  near.drop();
  EXPECT_FALSE(near.is_built());
}

}  // namespace
}  // namespace cbc3d

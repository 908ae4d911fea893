// A mesh that follows its lattice, against one that is made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/candidate_mesh.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::refine_at_random;

TEST(CandidateMesh, AMeshThatFollowsIsTheMeshMadeAnew) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  Lattice lattice = build_bcc_lattice(image, {6, 0.3});
  LatticeFollower follower(lattice);
  CandidateMesh mesh;
  TetNodes nodes;  // of the tets, carried along
  for (const std::uint32_t one_in : {20U, 500U, 5000U, 1000000000U}) {
    const UninitializedVector<TetId> number = follower.renumber();
    follower.rebuild(mesh, number);
    const LatticeTets tets = extract_tets(lattice);
    EXPECT_EQ(mesh.tets.nodes, tets.nodes);
    EXPECT_EQ(mesh.tets.parent, tets.parent);
    EXPECT_EQ(mesh.tets.green, tets.green);
    EXPECT_EQ(mesh.neighbours, tet_neighbours(tets.nodes, lattice.points.size()));
    nodes = renumbered(nodes, number, tets.size(), {0, 0, 0, 0});
    const auto kept =
        number.size() - static_cast<std::size_t>(std::count(number.begin(), number.end(), kNoTet));
    std::size_t alike = 0;
    for (std::size_t t = 0; t < tets.size(); ++t) {
      EXPECT_LE(follower.first(tets.parent[t]), t);
      EXPECT_LT(t, follower.first(tets.parent[t] + 1));
      alike += nodes[t] == tets.nodes[t] ? 1 : 0;
    }
    EXPECT_EQ(alike, kept);
    EXPECT_TRUE(one_in < 5000U || kept > tets.size() / 2) << kept << " of " << tets.size();
    nodes = tets.nodes;
    refine_at_random(lattice, 1, one_in, one_in);
  }
}

}  // namespace
}  // namespace cbc3d

// A mesh that is cut in patches and put together again.
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/edge_split.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/testing_trial.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using namespace testing;

TEST(MeshPatches, TheCutsAreInvisibleAndKeepTheMesh) {
  Trial trial(touching_balls());
  const auto volumes = trial.volumes();
  const std::size_t tets = trial.mesh.tets.size();
  trial.rules.patch_tets = 200;
  const std::size_t covered = covered_count(trial);
  std::atomic<std::size_t> seen = 0;
  std::atomic<int> patches = 0;
  trial.apply([&](Patch& patch) {  // nothing is done, nothing changes
    seen += patch.mesh.tet_slots();
    ++patches;
  });
  EXPECT_EQ(seen, tets);
  EXPECT_GT(patches, 4);
  EXPECT_EQ(trial.mesh.tets.size(), tets);
  expect_sound(trial, covered);
  for (std::size_t m = 1; m < volumes.size(); ++m) {
    EXPECT_NEAR(trial.volumes()[m], volumes[m], 1e-9 * volumes[m]);
  }
  const std::vector<long> chi = trial.characteristics();
  for (int round = 0; round < 6; ++round) {
    trial.apply(
        [&](Patch& p) {
          relax_vertices(p, kRelax);
          remove_edges(p, kGood);
          flatten_interfaces(p, kGoal);
          collapse_edges(p, {.threshold_quality = kGoal, .longest_growth = 2.5});
          optimize_worst_angles(p, kGoal);
        },
        round);
    expect_sound(trial, covered);
    EXPECT_EQ(trial.characteristics(), chi);
  }
  EXPECT_LT(trial.mesh.tets.size(), tets * 3 / 4);
}

TEST(MeshPatches, FixedVerticesStayAndOthersCollapseOntoThem) {
  Trial trial(touching_balls());
  trial.rules.patch_tets = 200;
  const auto sets =
      vertex_materials(trial.mesh.tets, trial.mesh.materials,
                       tet_neighbours(trial.mesh.tets, trial.mesh.points.size()), trial.mesh.points.size());
  std::vector<std::uint8_t> fixed;
  fixed.reserve(sets.size());
  for (std::size_t v = 0; v < sets.size(); ++v) {  // every third inner vertex
    fixed.push_back(sets[v].size == 1 && v % 3 == 0 ? 1 : 0);
  }
  trial.rules.fixed = fixed;
  const std::vector<Vec3> before = trial.mesh.points;
  const auto largest_star_of_fixed = [&] {
    const VertexCells around = tets_of_vertices(trial.mesh.tets, trial.mesh.points.size());
    std::size_t largest = 0;
    for (VertexId v = 0; v < fixed.size(); ++v) {
      if (fixed[v] != 0) {
        EXPECT_FALSE(around.of(v).empty());
        EXPECT_EQ(trial.mesh.points[v], before[v]);
        largest = std::max(largest, around.of(v).size());
      }
    }
    return largest;
  };
  const std::size_t largest = largest_star_of_fixed();
  const std::size_t covered = covered_count(trial);
  for (int round = 0; round < 4; ++round) {
    trial.apply(
        [&](Patch& p) {
          relax_vertices(p, kRelax);
          remove_edges(p, kGood);
          collapse_edges(p, {.threshold_quality = 0.02, .longest_growth = 5, .optimize_position = true});
          optimize_worst_angles(p, kGoal);
          split_edges(p, kGoal);
        },
        round);
    expect_sound(trial, covered);
  }
  EXPECT_GT(largest_star_of_fixed(), largest);
}

}  // namespace
}  // namespace cbc3d

// Collapses: what they keep, and how far they thin a mesh out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/testing_trial.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using namespace testing;

TEST(EdgeCollapse, RemovalAndCollapseMoveNoVolumeButAtTheBoundary) {
  Trial trial(touching_balls());
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const auto before = trial.volumes();
  trial.apply([&](Patch& p) {
    remove_edges(p, kGood);
    collapse_edges(p, {.threshold_sine_squared = kGoal, .longest_growth = 2.5});
  });
  for (std::size_t m = 1; m < before.size(); ++m) {
    // A sphere of radius 6 within the guard of .15 diagonals: less than 3 * .26 / 6 of its volume.
    EXPECT_NEAR(trial.volumes()[m], before[m], 0.13 * before[m]);
    EXPECT_NE(trial.volumes()[m], before[m]);
  }
}

TEST(EdgeCollapse, CollapsesStayWithinTheLongestEdge) {
  Trial trial(touching_balls());
  const auto longest = [&] {
    double squared = 0;
    for (const auto& n : trial.mesh.tets) {
      for (std::size_t i = 0; i < 4; ++i) {
        squared =
            std::max(squared, (trial.mesh.points[n[i]] - trial.mesh.points[n[(i + 1) % 4]]).squared_norm());
      }
    }
    return std::sqrt(squared);
  };
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const double limit = 1.3 * longest();
  const std::vector<double> limits(3, limit);
  std::size_t collapsed = 0;
  trial.apply([&](Patch& p) {
    collapsed +=
        collapse_edges(p, {.threshold_sine_squared = 0.05, .longest_growth = 10, .longest_mm = &limits});
  });
  EXPECT_GT(collapsed, 5U);
  EXPECT_LE(longest(), limit * (1 + 1e-9));
}

TEST(EdgeCollapse, CollapsesThatPlaceAnewKeepTheGuardsAndThinOutFurther) {
  for (const LabelImage& image : {touching_balls(), cavity_and_torus()}) {
    std::array<std::size_t, 2> left{};
    for (const bool optimize_position : {false, true}) {
      Trial trial(image);
      trial.apply([](Patch& p) { relax_vertices(p, kRelax); });
      trial.apply([](Patch& p) { remove_edges(p, kGood); });
      const std::size_t covered = covered_count(trial);
      const std::vector<long> chi = trial.characteristics();
      const double worst = trial.worst_sine_squared();
      CollapseOptions options{.threshold_sine_squared = kGoal, .longest_growth = 5};
      options.optimize_position = optimize_position;
      std::size_t removed = 1;
      for (int pass = 0; removed > 0; ++pass) {
        ASSERT_LT(pass, 40);  // they end
        removed = 0;
        trial.apply([&](Patch& p) { removed += collapse_edges(p, options); });
      }
      expect_sound(trial, covered);
      EXPECT_EQ(trial.characteristics(), chi);
      EXPECT_GE(trial.worst_sine_squared(), std::min(worst, kGoal) * (1 - 1e-9));
      left[optimize_position ? 1 : 0] = trial.mesh.tets.size();
    }
    EXPECT_LT(left[1], left[0] * 9 / 10);
  }
}

TEST(EdgeCollapse, CollapsesLeaveThinPartsTheirVolume) {
  // A plate of one voxel: with the share no more than a little of it is worn away.
  const LabelImage plate = testing::make_image({24, 24, 9}, {1, 1, 1}, 1, [](const Vec3& p) {
    return std::hypot(p.x - 11.5, p.y - 11.5) < 9 && std::fabs(p.z - 4) < 0.6 ? 1 : 0;
  });
  std::array<double, 2> kept{};
  for (const bool guarded : {false, true}) {
    Trial trial(plate);
    trial.apply([](Patch& p) { relax_vertices(p, kRelax); });
    const double before = trial.volumes()[1];
    CollapseOptions options{.threshold_sine_squared = 0.02, .longest_growth = 10};
    options.optimize_position = true;
    options.volume_share = guarded ? 0 : 1;
    std::size_t removed = 0;
    trial.apply([&](Patch& p) { removed += collapse_edges(p, options); });
    EXPECT_GT(removed, 10U);
    kept[guarded ? 1 : 0] = trial.volumes()[1] / before;
  }
  EXPECT_GE(kept[1], 1 - 1e-9);
  EXPECT_LT(kept[0], kept[1]);
}

}  // namespace
}  // namespace cbc3d

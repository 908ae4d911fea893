// What the guards of a patch promise holds for every operation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/patch.hpp"
#include "mesher/improve/local/testing_trial.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using namespace testing;

TEST(Patch, OperationsKeepAllThatTheGuardsPromise) {
  for (const LabelImage& image : {touching_balls(), cavity_and_torus()}) {
    Trial trial(image);
    const std::size_t covered = covered_count(trial);
    EXPECT_GT(covered, trial.samples.size() * 9 / 10);
    const std::vector<long> chi = trial.characteristics();
    if (image.frame.size[0] == 42) {
      ASSERT_EQ(chi, (std::vector<long>{4, 0}));
    }
    std::array<std::size_t, 6> done{};
    double worst = trial.worst_quality();
    for (int round = 0; round < 2; ++round) {
      const auto run = [&](std::size_t which, double floor,
                           const std::function<std::size_t(Patch&)>& operation) {
        trial.apply([&](Patch& patch) { done[which] += operation(patch); }, round);
        SCOPED_TRACE("operation " + std::to_string(which));
        expect_sound(trial, covered);
        EXPECT_EQ(trial.characteristics(), chi);
        const double after = trial.worst_quality();
        EXPECT_GE(after, std::min(worst, floor) * (1 - 1e-9));
        worst = after;
      };
      run(0, 0, [](Patch& p) { return relax_vertices(p, kRelax); });
      run(1, 1, [](Patch& p) { return remove_edges(p, kGood); });
      run(2, 0.999 * std::min(worst, kGoal), [](Patch& p) { return flatten_interfaces(p, kGoal); });
      run(3, kGoal,
          [](Patch& p) { return collapse_edges(p, {.threshold_quality = kGoal, .longest_growth = 2.5}); });
      run(0, 0, [](Patch& p) { return relax_vertices(p, kRelax); });
      run(4, 1, [](Patch& p) { return optimize_worst_angles(p, kGood); });
      run(5, 1, [](Patch& p) {
        return collapse_edges(p, {.threshold_quality = kGood, .longest_growth = 2.5, .only_bad = true});
      });
    }
    for (std::size_t which = 0; which < 5; ++which) {
      EXPECT_GT(done[which], 0U) << which;
    }
  }
}

TEST(Patch, OperationsLeaveVolumesAloneWhereTheBoundaryIsLocked) {
  Trial trial(touching_balls());
  const auto before = trial.volumes();
  const std::size_t tets = trial.mesh.tets.size();
  const std::size_t covered = covered_count(trial);
  const auto surfaces = [&] {
    return testing::surface_of_label(trial.mesh.tets, trial.mesh.materials, MaterialId{1});
  };
  const auto surface = surfaces();
  std::size_t done = 0;
  trial.apply([&](Patch& patch) {
    for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
      if (patch.on_boundary(v)) patch.mesh.lock(v);
    }
    done += relax_vertices(patch, kRelax) + remove_edges(patch, kGood) + optimize_worst_angles(patch, kGood) +
            collapse_edges(patch, {.threshold_quality = 0.05, .longest_growth = 2.5});
    EXPECT_EQ(flatten_interfaces(patch, 0), 0U);
    EXPECT_EQ(project_far_vertices(patch, kRelax), 0U);
  });
  EXPECT_GT(done, 30U);
  EXPECT_NE(trial.mesh.tets.size(), tets);
  expect_sound(trial, covered);
  EXPECT_EQ(surfaces(), surface);
  for (std::size_t m = 1; m < before.size(); ++m) {
    EXPECT_NEAR(trial.volumes()[m], before[m], 1e-9 * before[m]);
  }
}

}  // namespace
}  // namespace cbc3d

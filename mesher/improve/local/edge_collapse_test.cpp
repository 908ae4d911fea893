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
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using namespace testing;

TEST(EdgeCollapse, RemovalAndCollapseMoveNoVolumeButAtTheBoundary) {
  Trial trial(touching_balls());
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const auto before = trial.volumes();
  trial.apply([&](Patch& p) {
    remove_edges(p, kGood);
    collapse_edges(p, {.threshold_quality = kGoal, .longest_growth = 2.5});
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
    collapsed += collapse_edges(p, {.threshold_quality = 0.05, .longest_growth = 10, .longest_mm = &limits});
  });
  EXPECT_GT(collapsed, 5U);
  EXPECT_LE(longest(), limit * (1 + 1e-9));
}

TEST(EdgeCollapse, EdgesOfSurfacesHaveALimitOfTheirOwn) {
  Trial trial(touching_balls());
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const auto longest = [&](bool on_surface) {
    const auto neighbours = tet_neighbours(trial.mesh.tets, trial.mesh.points.size());
    double squared = 0;
    for (std::size_t t = 0; t < trial.mesh.tets.size(); ++t) {
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId across = neighbours[t][n];
        const bool inner = across != kNoTet && trial.mesh.materials[across] == trial.mesh.materials[t];
        for (std::size_t c = 0; inner != on_surface && c < 3; ++c) {
          const Vec3& p = trial.mesh.points[trial.mesh.tets[t][kTetFace[n][c]]];
          const Vec3& q = trial.mesh.points[trial.mesh.tets[t][kTetFace[n][(c + 1) % 3]]];
          squared = std::max(squared, (p - q).squared_norm());
        }
      }
    }
    return std::sqrt(squared);
  };
  const double limit = 1.1 * longest(true);
  std::size_t collapsed = 0;
  trial.apply([&](Patch& p) {
    collapsed +=
        collapse_edges(p, {.threshold_quality = 0.05, .longest_growth = 10, .longest_on_surface_mm = limit});
  });
  EXPECT_GT(collapsed, 5U);
  EXPECT_LE(longest(true), limit * (1 + 1e-9));
  EXPECT_GT(longest(false), limit);
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
      const double worst = trial.worst_quality();
      CollapseOptions options{.threshold_quality = kGoal, .longest_growth = 5};
      options.optimize_position = optimize_position;
      std::size_t removed = 1;
      for (int pass = 0; removed > 0; ++pass) {
        ASSERT_LT(pass, 40);  // they end
        removed = 0;
        trial.apply([&](Patch& p) { removed += collapse_edges(p, options); });
      }
      expect_sound(trial, covered);
      EXPECT_EQ(trial.characteristics(), chi);
      EXPECT_GE(trial.worst_quality(), std::min(worst, kGoal) * (1 - 1e-9));
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
    CollapseOptions options{.threshold_quality = 0.02, .longest_growth = 10};
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

/// The largest number of edges at a vertex.
std::size_t largest_valence(const MaterialMesh& mesh) {
  std::vector<std::vector<VertexId>> neighbours(mesh.points.size());
  for (const auto& tet : mesh.tets) {
    for (const VertexId v : tet) {
      for (const VertexId w : tet) {
        auto& known = neighbours[v];
        if (w != v && std::find(known.begin(), known.end(), w) == known.end()) {
          known.push_back(w);
        }
      }
    }
  }
  std::size_t largest = 0;
  for (const auto& known : neighbours) {
    largest = std::max(largest, known.size());
  }
  return largest;
}

TEST(EdgeCollapse, BoundsTheEdgesAtAVertex) {
  std::array<std::size_t, 2> largest{};
  for (const bool bounded : {false, true}) {
    Trial trial(touching_balls());
    CollapseOptions options{.threshold_quality = 0.01, .longest_growth = 10};
    options.largest_valence = bounded ? 20 : 1000;
    const std::size_t before = largest_valence(trial.mesh);
    for (int pass = 0; pass < 6; ++pass) {
      trial.apply([&](Patch& p) { collapse_edges(p, options); });
    }
    largest[bounded ? 1 : 0] = largest_valence(trial.mesh);
    EXPECT_LE(largest[1], std::max(before, std::size_t{20}));
  }
  EXPECT_GT(largest[0], largest[1]);
}

TEST(EdgeCollapse, EndsWhenThereAreNoMoreTetsThanAskedFor) {
  Trial free(touching_balls());
  const std::size_t before = free.mesh.tets.size();
  CollapseOptions options{.threshold_quality = 0.01, .longest_growth = 10};
  free.apply([&](Patch& p) { collapse_edges(p, options); });
  const std::size_t least = (before + free.mesh.tets.size()) / 2;
  Trial bounded(touching_balls());
  options.least_tets = least;
  bounded.apply([&](Patch& p) { collapse_edges(p, options); });
  EXPECT_LE(bounded.mesh.tets.size(), least);
  EXPECT_GT(bounded.mesh.tets.size() + 40, least);  // the last collapse took no more than a star
}

}  // namespace
}  // namespace cbc3d

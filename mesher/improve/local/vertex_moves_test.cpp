// Moves of vertices towards the boundary.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesher/improve/local/testing_trial.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::kRelax;
using testing::touching_balls;
using testing::Trial;

TEST(VertexMoves, ProjectFarVerticesBringsThemToTheBoundary) {
  Trial trial(touching_balls());
  const auto far_vertices = [&](Patch& patch) {
    std::size_t count = 0;
    for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
      if (patch.mesh.locked(v) || !patch.on_boundary(v)) continue;
      patch.mesh.star(v, patch.star);
      patch.mesh.facets(v, patch.star, patch.facets);
      const bool far = std::any_of(patch.facets.begin(), patch.facets.end(), [&](const FacetAt& f) {
        return trial.domain.boundary_distance(patch.mesh.point(v), f.inner, f.outer).deviation_mm >
               patch.guards.deviation_mm;
      });
      count += far ? 1 : 0;
    }
    return count;
  };
  trial.apply([&](Patch& patch) {
    const std::size_t before = far_vertices(patch);
    EXPECT_GT(before, 50U);
    EXPECT_GT(project_far_vertices(patch, kRelax), 0U);
    EXPECT_LT(far_vertices(patch), before / 10);
  });
}

/// The mean angle between neighbouring edges of the curve where two labels and the background meet, degrees.
double mean_kink_deg(const Trial& trial) {
  const auto neighbours = tet_neighbours(trial.mesh.tets, trial.mesh.points.size());
  std::map<std::array<VertexId, 2>, MaterialSet>
      edges;  // of the outside, with the materials of its facets there
  for (std::size_t t = 0; t < trial.mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t c = 0; neighbours[t][n] == kNoTet && c < 3; ++c) {
        const VertexId a = trial.mesh.tets[t][kTetFace[n][c]];
        const VertexId b = trial.mesh.tets[t][kTetFace[n][(c + 1) % 3]];
        edges[{std::min(a, b), std::max(a, b)}].add(trial.mesh.materials[t]);
      }
    }
  }
  std::map<VertexId, std::vector<VertexId>> beside;
  for (const auto& [edge, materials] : edges) {
    if (materials.size == 2) {
      beside[edge[0]].push_back(edge[1]);
      beside[edge[1]].push_back(edge[0]);
    }
  }
  double sum = 0;
  std::size_t count = 0;
  for (const auto& [v, ends] : beside) {
    if (ends.size() == 2) {
      const Vec3 in = (trial.mesh.points[v] - trial.mesh.points[ends[0]]).normalized();
      const Vec3 out = (trial.mesh.points[ends[1]] - trial.mesh.points[v]).normalized();
      sum += std::acos(std::clamp(in.dot(out), -1.0, 1.0)) * 180 / std::numbers::pi;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

TEST(VertexMoves, SmoothnessStraightensTheCurveWhereLabelsMeet) {
  std::array<double, 2> kink{};
  for (const bool smooth : {false, true}) {
    Trial trial(touching_balls());
    RelaxOptions options = kRelax;
    options.smoothness = smooth ? 0.7 : 0;
    options.smoothness_cap_mm = 0.5;
    for (int sweep = 0; sweep < 10; ++sweep) {
      trial.apply([&](Patch& p) { relax_vertices(p, options); });
    }
    kink[smooth ? 1 : 0] = mean_kink_deg(trial);
  }
  EXPECT_GT(kink[1], 0);
  EXPECT_LT(kink[1], 0.8 * kink[0]);
}

}  // namespace
}  // namespace cbc3d

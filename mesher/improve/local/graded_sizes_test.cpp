// Sizes that grow with the way from the interfaces, and collapses that keep to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/graded_sizes.hpp"
#include "mesher/improve/local/testing_fitted_ball.hpp"

namespace cbc3d {
namespace {

using testing::ball;
using testing::cut_block;
using testing::FittedBall;
using testing::for_each_edge;
using testing::lattice_mesh;

constexpr double kNoLimit = 1e9;

TEST(GradedSizes, NoneIsAboveTheLargest) {
  const MaterialMesh mesh = lattice_mesh(cut_block());
  const std::vector<double> free = graded_sizes(mesh, 0.3, kNoLimit);
  const double largest = *std::max_element(free.begin(), free.end());
  const std::vector<double> bound = graded_sizes(mesh, 0.3, 0.8 * largest);
  for (std::size_t v = 0; v < free.size(); ++v) {
    EXPECT_EQ(bound[v], std::min(free[v], 0.8 * largest));
  }
}

TEST(GradedSizes, SizesGrowFromTheInterfacesByTheWay) {
  const LabelImage image = cut_block();
  const MaterialMesh mesh = lattice_mesh(image);
  constexpr double kGradation = 0.3;
  const std::vector<double> flat = graded_sizes(mesh, 0, kNoLimit);
  const std::vector<double> sizes = graded_sizes(mesh, kGradation, kNoLimit);
  std::vector<double> least(mesh.points.size(), 1e300);  // by way of a neighbour
  const double smallest = *std::min_element(flat.begin(), flat.end());
  for_each_edge(mesh, [&](VertexId a, VertexId b, bool) {
    const double way = kGradation * (mesh.points[a] - mesh.points[b]).norm();
    least[a] = std::min(least[a], sizes[b] + way);
    least[b] = std::min(least[b], sizes[a] + way);
    EXPECT_LE(std::abs(sizes[a] - sizes[b]), way * (1 + 1e-12));
    EXPECT_EQ(flat[a], smallest);  // nothing grows: the smallest is everywhere
  });
  EXPECT_EQ(flat[0], smallest);
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  double largest = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    largest = std::max(largest, sizes[v]);
    if (sets[v].size < 2) {
      EXPECT_DOUBLE_EQ(sizes[v], least[v]);  // an inner vertex has its size from a neighbour
    }
  }
  EXPECT_GT(largest, smallest + 1);
}

TEST(GradedSizes, CollapsesKeepToIt) {
  FittedBall trial(lattice_mesh(ball(), 0.9), 0.25);
  const auto key = [](VertexId a, VertexId b) { return std::array{std::min(a, b), std::max(a, b)}; };
  std::set<std::array<VertexId, 2>> old;
  for_each_edge(trial.mesh, [&](VertexId a, VertexId b, bool) { old.insert(key(a, b)); });
  const std::vector<double> sizes = graded_sizes(trial.mesh, 0.3, kNoLimit);
  const auto longer_than_allowed = [&](bool graded) {
    MaterialMesh mesh = trial.mesh;
    std::vector<VertexId> covering = trial.covering;
    PatchRules rules{.boundaries = {trial.domain},
                     .guards = {.deviation_mm = 0.25, .scale_mm = std::sqrt(3.0)},
                     .samples = trial.domain.samples(),
                     .reach_mm = 1.6,
                     .patch_tets = 10000000};
    rules.longest_mm = sizes;
    std::size_t collapsed = 0;
    improve_in_patches(mesh, covering, rules, 0, [&](Patch& patch) {
      collapsed += collapse_edges(patch, {.threshold_quality = 0.03, .longest_growth = 4, .graded = graded});
    });
    EXPECT_GT(collapsed, 5U);
    std::size_t count = 0;
    for_each_edge(mesh, [&](VertexId a, VertexId b, bool inner) {
      const double length = (mesh.points[a] - mesh.points[b]).norm();
      count += inner && !old.contains(key(a, b)) && length > 0.5 * (sizes[a] + sizes[b]) ? 1 : 0;
    });
    return count;
  };
  EXPECT_GT(longer_than_allowed(false), 0U);
  EXPECT_EQ(longer_than_allowed(true), 0U);
}

}  // namespace
}  // namespace cbc3d

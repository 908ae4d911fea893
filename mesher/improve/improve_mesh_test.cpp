// The improvement as a whole: what it keeps, smoothness of the surfaces within a cap, growth of the elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesher/core/runtime.hpp"
#include "mesher/improve/improve_mesh.hpp"
#include "mesher/improve/local/graded_sizes.hpp"
#include "mesher/improve/local/testing_fitted_ball.hpp"
#include "mesher/improve/surface/volume_correction.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::ball;
using testing::cut_block;
using testing::FittedBall;
using testing::for_each_edge;
using testing::kBallCentre;
using testing::normal_error_deg;
using testing::touching_balls;

/// The lattice mesh of an image after the whole stage. Nearer to the boundary than by default, images of this
/// size have facets enough to be moved and tets within.
MaterialMesh improved(const LabelImage& image, ImproveOptions options,
                      double reach_diagonals = tolerances::kReach) {
  MaterialMesh mesh = testing::lattice_mesh(image, reach_diagonals);
  options.reach_mm = reach_diagonals * image.frame.voxel_diagonal_mm();
  if (reach_diagonals < tolerances::kReach) {
    options.deviation_diagonals = 0.2;
  }
  improve_mesh(mesh, ImageDomain(image), options, [](int) {});
  return mesh;
}

double normal_error_of_ball(const MaterialMesh& mesh) {
  return normal_error_deg(testing::surface_of_label(mesh.tets, mesh.materials, MaterialId{1}), mesh.points,
                          kBallCentre);
}

TEST(ImproveMesh, LeavesAGoodMeshGoodAndIsRepeatable) {
  const LabelImage image = touching_balls();
  MaterialMesh mesh = improved(image, {});
  MaterialMesh again = mesh;
  ImproveOptions options;
  int rounds = 0;
  const ImproveReport report = improve_mesh(mesh, ImageDomain(image), options, [&](int) { ++rounds; });
  improve_mesh(again, ImageDomain(image), options, [](int) {});
  EXPECT_EQ(mesh.points, again.points);
  EXPECT_EQ(mesh.tets, again.tets);
  EXPECT_GT(rounds, 0);
  EXPECT_LE(report.tets_after, report.tets_before);
  EXPECT_GE(report.min_dihedral_after_deg, 20);
  EXPECT_EQ(report.uncovered_samples, 0U);
}

TEST(ImproveMesh, SmoothnessFlattensWithinItsCap) {
  for (const double cap_mm : {0.05, 0.15, 0.25}) {
    FittedBall trial(improved(ball(), {}, 0.9), cap_mm);
    const double before = normal_error_deg(trial.surface(), trial.mesh.points, kBallCentre);
    const auto near_before = trial.deviations();
    for (int sweep = 0; sweep < 6; ++sweep) {
      EXPECT_GT(trial.relax({.surface_weight = 1000, .smoothness = 0.8, .smoothness_cap_mm = cap_mm}, cap_mm),
                0U);
    }
    EXPECT_EQ(testing::inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
    const double after = normal_error_deg(trial.surface(), trial.mesh.points, kBallCentre);
    EXPECT_LT(after, (cap_mm < 0.1 ? 0.99 : 0.95) * before) << cap_mm;
    std::size_t farther = 0;
    for (const auto& [v, deviation] : trial.deviations()) {
      EXPECT_LE(deviation, std::max(cap_mm, near_before.at(v)) * (1 + 1e-9)) << cap_mm;
      farther += deviation > near_before.at(v) + 0.01 ? 1 : 0;
    }
    EXPECT_GT(farther, 10U);  // it does take vertices off the image's boundary
  }
}

TEST(ImproveMesh, SmoothnessLeavesASphereAsItIs) {
  // On a sphere all neighbours agree on where a vertex is, however the facets are cut: nothing shrinks.
  FittedBall trial(improved(ball(), {}, 0.9), 0.25);
  for (const auto& [v, deviation] : trial.deviations()) {
    Vec3& p = trial.mesh.points[v];
    p = kBallCentre + 16.2 * (p - kBallCentre).normalized();
  }
  ASSERT_EQ(testing::inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
  for (int sweep = 0; sweep < 8; ++sweep) {
    trial.relax({.surface_weight = 1000, .smoothness = 1, .smoothness_cap_mm = 0.8},
                0.8);  // smoothness alone
  }
  double sum = 0;
  std::size_t far = 0;
  const auto deviations = trial.deviations();
  for (const auto& [v, deviation] : deviations) {
    const double off = (trial.mesh.points[v] - kBallCentre).norm() - 16.2;
    sum += off;
    far += std::abs(off) > 0.1 ? 1 : 0;
  }
  EXPECT_LT(std::abs(sum) / static_cast<double>(deviations.size()), 0.02);
  // Where tets would turn over, a vertex may go to the image's boundary instead.
  EXPECT_LT(far, deviations.size() / 20);
}

TEST(ImproveMesh, SmoothnessMakesFlatterSurfacesOfAsGoodTets) {
  const LabelImage image = ball();
  const auto voxels = static_cast<double>(image.voxels_per_material()[1]);
  const ImageDomain domain(image);
  for (const bool fine : {false, true}) {
    const auto mesh_with = [&](double smoothness) {
      ImproveOptions options;
      options.smoothness = smoothness;
      return fine ? improved(image, options, 0.9) : improved(image, options);
    };
    const MaterialMesh smooth = mesh_with(0.5);
    EXPECT_LT(normal_error_of_ball(smooth), 0.96 * normal_error_of_ball(mesh_with(0))) << fine;
    EXPECT_NEAR(extent_of_materials(smooth, 2).volume_mm3[1], voxels, 0.01 * voxels) << fine;
    // The stage's own boundary is moved by what the volume lacks; repair of the default's larger tets may go
    // to .5 diagonals.
    const double farthest_mm = (fine ? 0.45 : 0.55) * std::sqrt(3.0);
    for (const testing::FaceKey& f :
         testing::surface_of_label(smooth.tets, smooth.materials, MaterialId{1})) {
      for (const VertexId v : f) {
        EXPECT_LT(domain.boundary_distance(smooth.points[v], 1, kBackground).deviation_mm, farthest_mm);
      }
    }
  }
}

TEST(ImproveMesh, SmoothnessAndGradationAreTheSameAtAnyThreadCount) {
  const LabelImage image = cut_block();
  ImproveOptions options;
  options.smoothness = 0.4;
  options.smoothness_cap_mm = 0.2;
  options.gradation = 0.2;
  set_thread_count(1);
  const MaterialMesh one = improved(image, options);
  set_thread_count(2);
  const MaterialMesh two = improved(image, options);
  set_thread_count(0);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.tets, two.tets);
  EXPECT_EQ(testing::inverted_tets(two.tets, two.points), 0U);
}

TEST(ImproveMesh, FixedVerticesAndTheTetsBetweenThemStay) {
  const LabelImage image = ball();
  ImproveOptions options;
  options.gradation = 5;
  const double core_mm = 10;  // of the radius of 16.2: what is fixed is far from the surface
  MaterialMesh start = testing::lattice_mesh(image, tolerances::kReach);
  std::vector<std::uint8_t> fixed;
  fixed.reserve(start.points.size());
  for (const Vec3& p : start.points) {
    fixed.push_back((p - kBallCentre).norm() < core_mm ? 1 : 0);
  }
  const auto places_of_core = [&](const MaterialMesh& mesh) {
    std::vector<std::array<std::array<double, 3>, 4>> tets;
    for (const auto& tet : mesh.tets) {
      std::array<std::array<double, 3>, 4> places{};
      std::transform(tet.begin(), tet.end(), places.begin(), [&](VertexId v) {
        return std::array{mesh.points[v].x, mesh.points[v].y, mesh.points[v].z};
      });
      if (std::all_of(tet.begin(), tet.end(),
                      [&](VertexId v) { return (mesh.points[v] - kBallCentre).norm() < core_mm; })) {
        std::sort(places.begin(), places.end());
        tets.push_back(places);
      }
    }
    std::sort(tets.begin(), tets.end());
    return tets;
  };
  const auto core = places_of_core(start);
  ASSERT_GT(core.size(), 50U);
  std::vector<MaterialMesh> after;
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    after.push_back(start);
    const ImproveReport report = improve_mesh(
        after.back(), ImageDomain(image), options, [](int) {}, fixed);
    EXPECT_GE(report.min_dihedral_after_deg, 20);
    EXPECT_LT(report.tets_after, report.tets_before);
    const auto now = places_of_core(after.back());
    EXPECT_TRUE(std::includes(now.begin(), now.end(), core.begin(), core.end()));
  }
  set_thread_count(0);
  EXPECT_EQ(after[0].points, after[1].points);
  EXPECT_EQ(after[0].tets, after[1].tets);
  improve_mesh(start, ImageDomain(image), options, [](int) {});
  const auto free = places_of_core(start);
  EXPECT_FALSE(std::includes(free.begin(), free.end(), core.begin(), core.end()));
}

/// The largest ratio of an inner edge to what the gradation allows it.
double worst_growth(const MaterialMesh& mesh, double gradation) {
  const std::vector<double> sizes = graded_sizes(mesh, gradation, 1e9);
  double worst = 0;
  for_each_edge(mesh, [&](VertexId a, VertexId b, bool inner) {
    if (inner) {
      worst = std::max(worst, (mesh.points[a] - mesh.points[b]).norm() / (0.5 * (sizes[a] + sizes[b])));
    }
  });
  return worst;
}

TEST(ImproveMesh, GradationBoundsTheGrowthAndCostsTets) {
  const LabelImage image = ball();
  ImproveOptions ungraded;
  ungraded.gradation = -1;
  const MaterialMesh free = improved(image, ungraded, 0.9);
  const double growth = worst_growth(free, 0.2);
  std::size_t tets = free.tets.size();
  for (const double gradation : {0.8, 0.2}) {
    ImproveOptions options;
    options.gradation = gradation;
    const MaterialMesh mesh = improved(image, options, 0.9);
    EXPECT_GT(mesh.tets.size(), tets) << gradation;
    tets = mesh.tets.size();
    // The lattice itself doubles from cell to cell, and is not split: a quarter more than that, or at least
    // less than without a limit.
    EXPECT_LT(worst_growth(mesh, 0.2), gradation < 0.5 ? 2.5 : 0.9 * growth) << gradation;
  }
}

TEST(ImproveMesh, ThickPartsKnowNoThickness) {
  ImproveOptions free;
  free.edges_per_thickness = 0;
  const MaterialMesh without = improved(ball(), free), with = improved(ball(), {});
  EXPECT_EQ(without.points, with.points);
  EXPECT_EQ(without.tets, with.tets);
}

/// The mean angle between neighbouring edges of the curve where two labels and the background meet, degrees.
double mean_kink_deg(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::map<std::array<VertexId, 2>, MaterialSet>
      edges;  // of the outside, with the materials of its facets there
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t c = 0; neighbours[t][n] == kNoTet && c < 3; ++c) {
        const VertexId a = mesh.tets[t][kTetFace[n][c]];
        const VertexId b = mesh.tets[t][kTetFace[n][(c + 1) % 3]];
        edges[{std::min(a, b), std::max(a, b)}].add(mesh.materials[t]);
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
      const Vec3 in = (mesh.points[v] - mesh.points[ends[0]]).normalized();
      const Vec3 out = (mesh.points[ends[1]] - mesh.points[v]).normalized();
      sum += std::acos(std::clamp(in.dot(out), -1.0, 1.0)) * 180 / std::numbers::pi;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

TEST(ImproveMesh, SmoothnessStraightensTheCurveWhereLabelsMeet) {
  const LabelImage image = touching_balls();
  ImproveOptions free;
  free.smoothness = 0;
  const double kink_deg = mean_kink_deg(improved(image, free, 0.9));
  EXPECT_GT(kink_deg, 0);
  EXPECT_LT(mean_kink_deg(improved(image, {}, 0.9)), 0.8 * kink_deg);
}

}  // namespace
}  // namespace cbc3d

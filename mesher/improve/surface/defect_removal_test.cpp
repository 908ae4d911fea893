// Defects of surfaces that are repaired by changes which no single step would make.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/surface/defect_removal.hpp"
#include "mesher/improve/surface/relabel_tets.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d {
namespace {

using testing::faults;
using testing::kNear;
using testing::kPlane;
using testing::kSize;
using testing::layers;
using testing::open_gap;
using testing::plane_at;
using testing::PlaneDomain;
using testing::samples_on_plane;
using testing::two_layers;
using testing::worst_angle;

/// The layers with a lump of one's tets in the other, which hang together by faces, edges or vertices.
MaterialMesh with_lump(unsigned seed, std::size_t tets) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  std::mt19937 random(seed);
  const auto inside = [&](TetId t) {
    return std::all_of(mesh.tets[t].begin(), mesh.tets[t].end(), [&](VertexId v) {
      const Vec3& p = mesh.points[v];
      return std::min({p.x, p.y, p.z, kSize - p.x, kSize - p.y, kSize - p.z}) > 0.5;
    });
  };
  std::vector<TetId> lump;
  while (lump.size() < tets) {
    const auto t = static_cast<TetId>(random() % mesh.tets.size());
    const bool touches =
        lump.empty() || std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(), [&](VertexId v) {
          return std::any_of(lump.begin(), lump.end(), [&](TetId other) {
            return std::count(mesh.tets[other].begin(), mesh.tets[other].end(), v) > 0;
          });
        });
    if (mesh.materials[t] == 2 && inside(t) && touches) {
      lump.push_back(t);
      mesh.materials[t] = 1;
    }
  }
  return mesh;
}

/// Vertices on the surface between the layers that are off their plane, by faces alone.
std::size_t far_vertices(const MaterialMesh& mesh) {
  std::set<VertexId> off;
  for (const auto& face : testing::surface_of_label(mesh.tets, mesh.materials, MaterialId{1})) {
    for (const VertexId v : face) {
      const Vec3& p = mesh.points[v];
      const bool inside = std::min({p.x, p.y, p.z, kSize - p.x, kSize - p.y, kSize - p.z}) > 0;
      if (inside && std::fabs(p.z - kPlane) > kNear) off.insert(v);
    }
  }
  return off.size();
}

DefectRemovalOptions options(double limit_mm) {
  DefectRemovalOptions mend;
  mend.limit_mm = limit_mm;
  mend.step_mm = 1;
  mend.goal_quality = quality_of_deg(20);
  return mend;
}

/// What relabelling tet by tet, or by a vertex's star, gets stuck at.
TEST(RemoveSurfaceDefects, LumpsThatRelabellingLeavesAreMended) {
  const std::vector<BoundarySample> points = samples_on_plane();
  int stuck = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    MaterialMesh mesh = with_lump(seed, 5);
    ASSERT_GT(far_vertices(mesh) + faults(mesh), 0U);
    std::vector<VertexId> covering(points.size(), kNoVertex);
    SurfaceCover cover(points, covering, mesh.points.size(), 1);
    RelabelOptions short_steps;
    short_steps.step_mm = 0.5;
    relabel_misplaced_tets(mesh, cover, layers(), short_steps);
    stuck += far_vertices(mesh) + faults(mesh) > 0 ? 1 : 0;
    const double worst = worst_angle(mesh);
    const DefectRemovalReport report = remove_surface_defects(mesh, layers(), options(1));
    EXPECT_EQ(far_vertices(mesh), 0U) << seed;
    EXPECT_EQ(faults(mesh), 0U) << seed;
    EXPECT_EQ(report.defects_left, 0U) << seed;
    EXPECT_GE(worst_angle(mesh), std::min(worst, options(1).goal_quality)) << seed;
  }
  EXPECT_GT(stuck, 10);
}

TEST(RemoveSurfaceDefects, TheSameAtAnyThreadCount) {
  const std::vector<BoundarySample> points = samples_on_plane();
  const int threads = omp_get_max_threads();
  for (unsigned seed = 100; seed < 104; ++seed) {
    std::vector<MaterialMesh> results;
    for (const int count : {1, 3}) {
      omp_set_num_threads(count);
      results.push_back(with_lump(seed, 8));
      remove_surface_defects(results.back(), layers(), options(1));
    }
    omp_set_num_threads(threads);
    EXPECT_EQ(results[0].tets, results[1].tets);
    EXPECT_EQ(results[0].materials, results[1].materials);
    EXPECT_EQ(results[0].points, results[1].points);
  }
}

TEST(RemoveSurfaceDefects, NothingIsDoneToACleanMeshNorBeyondTheTrials) {
  const std::vector<BoundarySample> points = samples_on_plane();
  const MaterialMesh clean = two_layers(kSize, kPlane);
  MaterialMesh mesh = clean;
  EXPECT_EQ(remove_surface_defects(mesh, layers(), options(1)).defects, 0U);
  EXPECT_EQ(mesh.points, clean.points);
  EXPECT_EQ(mesh.materials, clean.materials);

  const MaterialMesh lump = with_lump(7, 5);
  mesh = lump;
  DefectRemovalOptions few = options(1);
  few.most_trials = 1;
  const std::size_t faults = remove_surface_defects(mesh, layers(), few).defects;
  ASSERT_GT(faults, 0U);
  // Trials that would not do for a look at every fault are not begun with; with more some are used.
  for (const std::size_t trials : {8 * faults - 1, 400 * faults}) {
    mesh = lump;
    few.most_trials = trials;
    const DefectRemovalReport report = remove_surface_defects(mesh, layers(), few);
    EXPECT_EQ(report.tets_relabelled + report.vertices_moved > 0, trials > 8 * faults);
    EXPECT_EQ(report.defects_left<faults, trials> 8 * faults);
    EXPECT_EQ(mesh.materials == lump.materials && mesh.points == lump.points, trials < 8 * faults);
  }
}

TEST(RemoveSurfaceDefects, TheLastTetsOfAMaterialStay) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  for (TetId t = 0;; ++t) {  // one tet of material 3 where the image has none
    const auto& n = mesh.tets[t];
    if (std::all_of(n.begin(), n.end(), [&](VertexId v) {
          return (mesh.points[v] - Vec3{3, 3, 4.5}).norm() < 2;
        })) {
      mesh.materials[t] = 3;
      break;
    }
  }
  const PlaneDomain image(kSize, kPlane, testing::kNear, samples_on_plane(), 4);
  remove_surface_defects(mesh, image, options(1));
  EXPECT_GE(std::count(mesh.materials.begin(), mesh.materials.end(), MaterialId{3}), 1);
}

TEST(RemoveSurfaceDefects, AnUncoveredSampleIsCovered) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  std::vector<BoundarySample> points = samples_on_plane();
  points.push_back({{3, 3, 3.9F}, 1, 2});  // 0.15 mm too far, where a vertex may go
  const PlaneDomain image = plane_at(kSize, kPlane, 0.5, points);
  const DefectRemovalReport report = remove_surface_defects(mesh, image, options(0.75));
  EXPECT_GT(report.defects, 0U);
  EXPECT_EQ(report.defects_left, 0U);
  double nearest = 1e9;
  for (const auto& face : testing::surface_of_label(mesh.tets, mesh.materials, MaterialId{1})) {
    for (const VertexId v : face) {
      nearest = std::min(nearest, (mesh.points[v] - points.back().centre()).norm());
    }
  }
  EXPECT_LE(nearest, 0.75);
  EXPECT_EQ(faults(mesh), 0U);
}

/// Three tets around an axis above a gap, whose lowest vertex is at `level`, and one below it.
MaterialMesh pancake(double level) {
  MaterialMesh mesh;
  mesh.points = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, level}};
  mesh.tets = {{5, 0, 1, 3}, {5, 1, 2, 3}, {5, 2, 0, 3}, {0, 2, 1, 4}};
  mesh.materials.assign(4, 1);
  return mesh;
}

TEST(RemoveSurfaceDefects, AGapThatIsInsideOutIsTurnedBack) {
  const PlaneDomain image = plane_at(kSize, kPlane, 10);  // everything is near its boundary
  const std::vector<BoundarySample> none;
  for (const double level : {0.05, -0.05}) {
    MaterialMesh mesh = pancake(level);
    ASSERT_GT(worst_angle(mesh), 0);
    EXPECT_EQ(find_surface_defects(LabelledComplex(mesh, image.label_of()), image, 1).folds.empty(),
              level > 0);
  }
  // The rim of the gap is pinched, which no step of a vertex mends: what is under test is the gap.
  MaterialMesh mesh = pancake(-0.05);
  DefectRemovalOptions steps_alone = options(1);
  steps_alone.largest_mm3 = 0;
  const double worst = worst_angle(mesh);
  const DefectRemovalReport report = remove_surface_defects(mesh, image, steps_alone);
  EXPECT_GE(report.folds, 3U);
  EXPECT_EQ(report.folds_left, 0U);
  EXPECT_EQ(report.self_intersections_left, 0U);
  EXPECT_EQ(report.tets_relabelled, 0U);
  EXPECT_GT(six_volumes(mesh.points[0], mesh.points[1], mesh.points[2], mesh.points[5]), 0);
  EXPECT_GE(worst_angle(mesh), std::min(worst, options(1).goal_quality));
}

/// The pancake over a tet of two materials, an inner one under the gap; and its lowest vertex elsewhere.
MaterialMesh filled_pancake(const Vec3& lowest) {
  MaterialMesh mesh = pancake(0);
  mesh.points[5] = lowest;
  mesh.points.push_back({0, 0, -0.3});
  mesh.tets.back() = {0, 2, 1, 6};
  for (const auto& tet : TetNodes{{0, 1, 4, 6}, {1, 2, 4, 6}, {2, 0, 4, 6}}) {
    mesh.tets.push_back(tet);
    mesh.materials.push_back(2);
  }
  return mesh;
}

TEST(RemoveSurfaceDefects, AnOuterSurfaceThatCutsAnInnerOneIsDrawnOut) {
  std::mt19937 random(5);
  const PlaneDomain image = plane_at(kSize, kPlane, 10);
  const std::vector<BoundarySample> none;
  DefectRemovalOptions steps_alone = options(1);
  steps_alone.largest_mm3 = 0;
  int tried = 0;
  for (int n = 0; n < 200; ++n) {
    const auto draw = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
    MaterialMesh mesh = filled_pancake({draw(-0.3, 0.5), draw(-0.4, 0.4), draw(-0.3, -0.05)});
    ASSERT_EQ(testing::inverted_tets(mesh.tets, mesh.points), 0U);
    const std::size_t intersections = count_self_intersections(mesh, image.label_of());
    EXPECT_EQ(find_surface_defects(LabelledComplex(mesh, image.label_of()), image, 1).self_intersections,
              intersections);
    if (intersections == 0) {
      continue;
    }
    ++tried;
    const DefectRemovalReport report = remove_surface_defects(mesh, image, steps_alone);
    EXPECT_EQ(report.self_intersections_left, 0U);
    EXPECT_EQ(count_self_intersections(mesh, image.label_of()), 0U);
    EXPECT_EQ(report.tets_relabelled, 0U);
  }
  EXPECT_GT(tried, 20);
}

TEST(RemoveSurfaceDefects, TipsAcrossAGapNoLongerCut) {
  std::mt19937 random(11);
  for (int n = 0; n < 12; ++n) {
    MaterialMesh mesh = two_layers(kSize, 2);
    const auto draw = [&] { return 0.6 * (random() / 4294967296.0 - 0.5); };
    open_gap(mesh, kSize, {3 + draw(), 3 + draw(), 3.2 + draw()});
    std::vector<VertexId> covering;
    const std::vector<BoundarySample> none;
    SurfaceCover cover(none, covering, mesh.points.size(), 1);
    if (MaterialMesh copy = mesh;
        separate_self_intersections(copy, cover, {.step_mm = 0.1, .goal_quality = 0, .rounds = 0}) == 0) {
      continue;  // this one does not reach over
    }
    const DefectRemovalReport report = remove_surface_defects(mesh, plane_at(kSize, 2.5, 10), options(1));
    EXPECT_GT(report.defects, 0U);
    EXPECT_EQ(report.self_intersections_left, 0U);
    EXPECT_EQ(separate_self_intersections(mesh, cover, {.step_mm = 0.1, .goal_quality = 0, .rounds = 0}), 0U);
    EXPECT_EQ(faults(mesh), 0U);
  }
}

}  // namespace
}  // namespace cbc3d

// The end game: faults of surfaces counted, and mended by changes that no single step would make.
#include <gtest/gtest.h>
#include <omp.h>

#include <random>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/surface_repair.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/improve/surface/tet_groups.hpp"

namespace cbc3d {
namespace {

using testing::faults;
using testing::open_gap;
using testing::plane_at;
using testing::two_layers;

constexpr int kSize = 6;
constexpr double kPlane = 3;
constexpr double kNear = 0.6;

/// Boundary voxels on the plane between the layers, one a square.
std::vector<InterfacePoint> points_on_plane() {
  std::vector<InterfacePoint> points;
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      points.push_back({{static_cast<float>(i + 0.5), static_cast<float>(j + 0.5), float{kPlane}}, 1, 2});
    }
  }
  return points;
}

ImagePlaces places() {
  return plane_at(kSize, kPlane, kNear);
}

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
std::size_t strays(const MaterialMesh& mesh) {
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

MendOptions options(double limit_mm) {
  MendOptions mend;
  mend.limit_mm = limit_mm;
  mend.step_mm = 1;
  mend.goal_sine_squared = sine_squared_of_deg(20);
  return mend;
}

double worst_angle(const MaterialMesh& mesh) {
  double worst = 1;
  for (TetId t = 0; t < mesh.tets.size(); ++t) worst = std::min(worst, worst_sine_squared(mesh, {&t, 1}));
  return worst;
}

TEST(SurfaceDefects, AreBetterOnlyWhereNothingIsWorse) {
  const SurfaceDefects base{2, 3, 1.5, 1.2};
  EXPECT_FALSE(base.is_better_than(base, true));
  EXPECT_TRUE((SurfaceDefects{1, 3, 1.5, 1.2}.is_better_than(base, false)));
  EXPECT_TRUE((SurfaceDefects{2, 3, 0, 1.2}.is_better_than(base, false)));
  EXPECT_FALSE((SurfaceDefects{0, 0, 1.6, 0}.is_better_than(base, true)));
  EXPECT_FALSE((SurfaceDefects{0, 0, 0, 1.3}.is_better_than(base, true)));
  EXPECT_FALSE((SurfaceDefects{3, 1, 1.5, 1.2}.is_better_than(base, false)));
  EXPECT_TRUE((SurfaceDefects{3, 1, 1.5, 1.2}.is_better_than(base, true)));  // a cut for a pinch
  EXPECT_FALSE((SurfaceDefects{3, 3, 0, 0}.is_better_than(base, true)));
  EXPECT_TRUE((SurfaceDefects{2, 2, 1.5, 1.2, 9}.is_better_than(base, false)));  // folds count last
  EXPECT_FALSE((SurfaceDefects{3, 3, 1.5, 1.2, 0}.is_better_than({2, 3, 1.5, 1.2, 4}, true)));
  EXPECT_TRUE((SurfaceDefects{2, 3, 1.5, 1.2, 3}.is_better_than({2, 3, 1.5, 1.2, 4}, false)));
}

TEST(SurfaceDefects, NoneInCleanLayersAndEachKindWhereItIs) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const ImagePlaces image = places();
  std::vector<InterfacePoint> points = points_on_plane();
  const SurfaceGuide guide{points, image, 1};
  {
    const LabelledComplex complex(mesh, image.label_of);
    EXPECT_TRUE(find_surface_defects(complex, guide).seeds.empty());
  }
  // A point beyond the surface's reach is lonely, and its neighbours are known.
  points.push_back({{3, 3, 4.5F}, 1, 2});
  {
    const LabelledComplex complex(mesh, image.label_of);
    const FaultList faults_found = find_surface_defects(complex, guide);
    ASSERT_EQ(faults_found.seeds.size(), 1U);
    for (const VertexId v : faults_found.seeds[0]) {
      EXPECT_LE((mesh.points[v] - points.back().centre()).norm(), 1.5);
    }
    FaultMeter meter(complex, guide);
    meter.look_at(faults_found.seeds[0]);
    const FaultMeter::Scope scope = meter.scope_of(faults_found.seeds[0]);
    EXPECT_NEAR(meter.measure(scope).lonely, 1.5, 1e-6);
    EXPECT_EQ(meter.lonely_points(scope).size(), 1U);
  }
  points.pop_back();
  // A tet beyond the plane: its tip is far from where both materials belong.
  const VertexId tip = [&] {
    for (TetId t = 0;; ++t) {
      const auto& n = mesh.tets[t];
      const auto on_plane =
          std::count_if(n.begin(), n.end(), [&](VertexId v) { return mesh.points[v].z == kPlane; });
      if (mesh.materials[t] == 2 && on_plane == 3 && mesh.points[n[0]].x == 3 && mesh.points[n[0]].y == 3) {
        mesh.materials[t] = 1;
        return *std::max_element(n.begin(), n.end(),
                                 [&](VertexId a, VertexId b) { return mesh.points[a].z < mesh.points[b].z; });
      }
    }
  }();
  const LabelledComplex complex(mesh, image.label_of);
  const FaultList faults_found = find_surface_defects(complex, guide);
  ASSERT_EQ(faults_found.seeds.size(), 1U);
  EXPECT_EQ(faults_found.seeds[0], std::vector<VertexId>{tip});
  EXPECT_EQ(faults_found.cuts, 0U);
  FaultMeter meter(complex, guide);
  EXPECT_NEAR(meter.far({tip}), 2, 1e-9);  // one millimetre from the plane, of both
  EXPECT_EQ(meter.pinches({tip}), 0U);
}

TEST(TetGroups, AreConnectedOfOneMaterialAndTheSmallestFirst) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const std::vector<MaterialId> label_of = {0, 1, 2};
  const LabelledComplex complex(mesh, label_of);
  const auto middle = static_cast<VertexId>((3 * 7 + 3) * 7 + 3);
  const auto groups = tet_groups_at(complex, {middle}, 3);
  std::set<TetGroup> distinct(groups.begin(), groups.end());
  EXPECT_EQ(distinct.size(), groups.size());
  double last = 0;
  for (const TetGroup& group : groups) {
    ASSERT_TRUE(std::is_sorted(group.begin(), group.end()));
    EXPECT_GE(volume_mm3(mesh, group), last);
    last = volume_mm3(mesh, group);
    TetGroup reached = {group[0]};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      EXPECT_EQ(mesh.materials[reached[i]], mesh.materials[group[0]]);
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId next = complex.neighbour(reached[i], n);
        if (std::count(group.begin(), group.end(), next) > 0 &&
            std::count(reached.begin(), reached.end(), next) == 0) {
          reached.push_back(next);
        }
      }
    }
    EXPECT_EQ(reached.size(), group.size());
  }
  const auto star = complex.star(middle);
  std::size_t pairs = 0;
  for (const TetId t : star) {
    EXPECT_EQ(distinct.count({t}), 1U);
    for (const TetId u : star) {
      for (std::size_t n = 0; n < 4; ++n) {
        pairs += t < u && complex.neighbour(t, n) == u && mesh.materials[t] == mesh.materials[u] ? 1 : 0;
        if (t < u && complex.neighbour(t, n) == u && mesh.materials[t] == mesh.materials[u]) {
          EXPECT_EQ(distinct.count({t, u}), 1U);
        }
      }
    }
  }
  EXPECT_GT(pairs, 10U);
}

/// What relabelling tet by tet, or by a vertex's star, gets stuck at.
TEST(MendSurfaces, LumpsThatRelabellingLeavesAreMended) {
  const std::vector<InterfacePoint> points = points_on_plane();
  int stuck = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    MaterialMesh mesh = with_lump(seed, 5);
    ASSERT_GT(strays(mesh) + faults(mesh), 0U);
    std::vector<VertexId> hosts(points.size(), kNoVertex);
    CoveredSamples hosted(points, hosts, mesh.points.size(), 1);
    RelabelOptions short_steps;
    short_steps.reach_mm = 0.5;
    relabel_misplaced_tets(mesh, hosted, places(), short_steps);
    stuck += strays(mesh) + faults(mesh) > 0 ? 1 : 0;
    const double worst = worst_angle(mesh);
    const MendReport report = mend_surfaces(mesh, points, places(), options(1));
    EXPECT_EQ(strays(mesh), 0U) << seed;
    EXPECT_EQ(faults(mesh), 0U) << seed;
    EXPECT_EQ(report.faults_left, 0U) << seed;
    EXPECT_GE(worst_angle(mesh), std::min(worst, options(1).goal_sine_squared)) << seed;
  }
  EXPECT_GT(stuck, 10);
}

TEST(MendSurfaces, TheSameAtAnyThreadCount) {
  const std::vector<InterfacePoint> points = points_on_plane();
  const int threads = omp_get_max_threads();
  for (unsigned seed = 100; seed < 104; ++seed) {
    std::vector<MaterialMesh> results;
    for (const int count : {1, 3}) {
      omp_set_num_threads(count);
      results.push_back(with_lump(seed, 8));
      mend_surfaces(results.back(), points, places(), options(1));
    }
    omp_set_num_threads(threads);
    EXPECT_EQ(results[0].tets, results[1].tets);
    EXPECT_EQ(results[0].materials, results[1].materials);
    EXPECT_EQ(results[0].points, results[1].points);
  }
}

TEST(MendSurfaces, NothingIsDoneToACleanMeshNorBeyondTheTrials) {
  const std::vector<InterfacePoint> points = points_on_plane();
  const MaterialMesh clean = two_layers(kSize, kPlane);
  MaterialMesh mesh = clean;
  EXPECT_EQ(mend_surfaces(mesh, points, places(), options(1)).faults, 0U);
  EXPECT_EQ(mesh.points, clean.points);
  EXPECT_EQ(mesh.materials, clean.materials);

  const MaterialMesh lump = with_lump(7, 5);
  mesh = lump;
  MendOptions few = options(1);
  few.most_trials = 1;
  const std::size_t faults = mend_surfaces(mesh, points, places(), few).faults;
  ASSERT_GT(faults, 0U);
  // Trials that would not do for a look at every fault are not begun with; with more some are used.
  for (const std::size_t trials : {8 * faults - 1, 400 * faults}) {
    mesh = lump;
    few.most_trials = trials;
    const MendReport report = mend_surfaces(mesh, points, places(), few);
    EXPECT_EQ(report.tets_relabelled + report.vertices_moved > 0, trials > 8 * faults);
    EXPECT_EQ(report.faults_left<faults, trials> 8 * faults);
    EXPECT_EQ(mesh.materials == lump.materials && mesh.points == lump.points, trials < 8 * faults);
  }
}

TEST(MendSurfaces, TheLastTetsOfAMaterialStay) {
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
  ImagePlaces image = places();
  image.label_of = {0, 1, 2, 3};
  mend_surfaces(mesh, points_on_plane(), image, options(1));
  EXPECT_GE(std::count(mesh.materials.begin(), mesh.materials.end(), MaterialId{3}), 1);
}

TEST(MendSurfaces, ALonelyBoundaryVoxelIsReached) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  std::vector<InterfacePoint> points = points_on_plane();
  points.push_back({{3, 3, 3.9F}, 1, 2});  // 0.15 mm too far, where a vertex may go
  const ImagePlaces image = plane_at(kSize, kPlane, 0.5);
  const MendReport report = mend_surfaces(mesh, points, image, options(0.75));
  EXPECT_GT(report.faults, 0U);
  EXPECT_EQ(report.faults_left, 0U);
  double nearest = 1e9;
  for (const auto& face : testing::surface_of_label(mesh.tets, mesh.materials, MaterialId{1})) {
    for (const VertexId v : face) {
      nearest = std::min(nearest, (mesh.points[v] - points.back().centre()).norm());
    }
  }
  EXPECT_LE(nearest, 0.75);
  EXPECT_EQ(faults(mesh), 0U);
}

TEST(FacetsFold, WhereOneLiesInTheTetBehindTheOther) {
  // Facet 0 1 2 with the tet's vertex 3 below it, and facets at edge 0 1 whose tets lie on their far side.
  std::vector<Vec3> points = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {0, 0.5, -1}, {}, {}};
  const auto fold = [&](const Vec3& to, const Vec3& behind) {
    points[4] = to;
    points[5] = behind;
    return facets_fold(points, {0, 1, 2}, 3, {0, 1, 4}, 5);
  };
  EXPECT_FALSE(fold({-1, 0.5, 0.5}, {-1, 0.5, -0.5}));
  EXPECT_FALSE(fold({0.5, 0.5, 0.1}, {-1, 0.5, 0.5}));            // a narrow gap between the two
  EXPECT_TRUE(fold({0.5, 0.5, -0.1}, {-1, 0.5, 0.5}));            // none: one within the other's tet
  EXPECT_TRUE(fold({-1, 0.5, 1}, {1, 0.5, -0.1}));                // likewise the other way round
  EXPECT_FALSE(facets_fold(points, {0, 1, 2}, 3, {0, 1, 3}, 2));  // two facets of one tet
  EXPECT_FALSE(facets_fold(points, {0, 1, 2}, 3, {0, 4, 5}, 1));  // one vertex in common
}

/// Three tets round an axis above a gap, whose lowest vertex is at `level`, and one below it.
MaterialMesh pancake(double level) {
  MaterialMesh mesh;
  mesh.points = {{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, level}};
  mesh.tets = {{5, 0, 1, 3}, {5, 1, 2, 3}, {5, 2, 0, 3}, {0, 2, 1, 4}};
  mesh.materials.assign(4, 1);
  return mesh;
}

TEST(MendSurfaces, AGapThatIsInsideOutIsTurnedBack) {
  const ImagePlaces image = plane_at(kSize, kPlane, 10);  // everything is near its boundary
  const std::vector<InterfacePoint> none;
  const SurfaceGuide guide{none, image, 1};
  for (const double level : {0.05, -0.05}) {
    MaterialMesh mesh = pancake(level);
    ASSERT_GT(worst_angle(mesh), 0);
    EXPECT_EQ(find_surface_defects(LabelledComplex(mesh, image.label_of), guide).folds.empty(), level > 0);
  }
  // The rim of the gap is pinched, which no step of a vertex mends: what is under test is the gap.
  MaterialMesh mesh = pancake(-0.05);
  MendOptions steps_alone = options(1);
  steps_alone.largest_mm3 = 0;
  const double worst = worst_angle(mesh);
  const MendReport report = mend_surfaces(mesh, none, image, steps_alone);
  EXPECT_GE(report.folds, 3U);
  EXPECT_EQ(report.folds_left, 0U);
  EXPECT_EQ(report.cuts_left, 0U);
  EXPECT_EQ(report.tets_relabelled, 0U);
  EXPECT_GT(six_volumes(mesh.points[0], mesh.points[1], mesh.points[2], mesh.points[5]), 0);
  EXPECT_GE(worst_angle(mesh), std::min(worst, options(1).goal_sine_squared));
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

TEST(MendSurfaces, AnOuterSurfaceThatCutsAnInnerOneIsDrawnOut) {
  std::mt19937 random(5);
  const ImagePlaces image = plane_at(kSize, kPlane, 10);
  const std::vector<InterfacePoint> none;
  const SurfaceGuide guide{none, image, 1};
  MendOptions steps_alone = options(1);
  steps_alone.largest_mm3 = 0;
  int tried = 0;
  for (int n = 0; n < 200; ++n) {
    const auto draw = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
    MaterialMesh mesh = filled_pancake({draw(-0.3, 0.5), draw(-0.4, 0.4), draw(-0.3, -0.05)});
    ASSERT_EQ(testing::inverted_tets(mesh.tets, mesh.points), 0U);
    const std::size_t crossings = count_crossings_of_labels(mesh, image.label_of);
    EXPECT_EQ(find_surface_defects(LabelledComplex(mesh, image.label_of), guide).cuts, crossings);
    if (crossings == 0) {
      continue;
    }
    ++tried;
    const MendReport report = mend_surfaces(mesh, none, image, steps_alone);
    EXPECT_EQ(report.cuts_left, 0U);
    EXPECT_EQ(count_crossings_of_labels(mesh, image.label_of), 0U);
    EXPECT_EQ(report.tets_relabelled, 0U);
  }
  EXPECT_GT(tried, 20);
}

TEST(MendSurfaces, TipsAcrossAGapNoLongerCut) {
  std::mt19937 random(11);
  for (int n = 0; n < 12; ++n) {
    MaterialMesh mesh = two_layers(kSize, 2);
    const auto draw = [&] { return 0.6 * (random() / 4294967296.0 - 0.5); };
    open_gap(mesh, kSize, {3 + draw(), 3 + draw(), 3.2 + draw()});
    std::vector<VertexId> hosts;
    const std::vector<InterfacePoint> none;
    CoveredSamples hosted(none, hosts, mesh.points.size(), 1);
    if (MaterialMesh copy = mesh; separate_crossings(copy, hosted, {0.1, 0, 0}) == 0) {
      continue;  // this one does not reach over
    }
    const MendReport report = mend_surfaces(mesh, none, plane_at(kSize, 2.5, 10), options(1));
    EXPECT_GT(report.faults, 0U);
    EXPECT_EQ(report.cuts_left, 0U);
    EXPECT_EQ(separate_crossings(mesh, hosted, {0.1, 0, 0}), 0U);
    EXPECT_EQ(faults(mesh), 0U);
  }
}

}  // namespace
}  // namespace cbc3d

// Defects of surfaces, counted and compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mesher/improve/surface/surface_defects.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"

namespace cbc3d {
namespace {

using testing::kPlane;
using testing::kSize;
using testing::layers;
using testing::PlaneDomain;
using testing::samples_on_plane;
using testing::two_layers;

TEST(SurfaceDefects, AreBetterOnlyWhereNothingIsWorse) {
  const SurfaceDefects base{2, 3, 1.5, 1.2};
  EXPECT_FALSE(base.is_better_than(base, true));
  EXPECT_TRUE((SurfaceDefects{1, 3, 1.5, 1.2}.is_better_than(base, false)));
  EXPECT_TRUE((SurfaceDefects{2, 3, 0, 1.2}.is_better_than(base, false)));
  EXPECT_FALSE((SurfaceDefects{0, 0, 1.6, 0}.is_better_than(base, true)));
  EXPECT_FALSE((SurfaceDefects{0, 0, 0, 1.3}.is_better_than(base, true)));
  EXPECT_FALSE((SurfaceDefects{3, 1, 1.5, 1.2}.is_better_than(base, false)));
  EXPECT_TRUE(
      (SurfaceDefects{3, 1, 1.5, 1.2}.is_better_than(base, true)));  // a self-intersection for a pinch
  EXPECT_FALSE((SurfaceDefects{3, 3, 0, 0}.is_better_than(base, true)));
  EXPECT_TRUE((SurfaceDefects{2, 2, 1.5, 1.2, 9}.is_better_than(base, false)));  // folds count last
  EXPECT_FALSE((SurfaceDefects{3, 3, 1.5, 1.2, 0}.is_better_than({2, 3, 1.5, 1.2, 4}, true)));
  EXPECT_TRUE((SurfaceDefects{2, 3, 1.5, 1.2, 3}.is_better_than({2, 3, 1.5, 1.2, 4}, false)));
}

TEST(SurfaceDefects, NoneInCleanLayersAndEachKindWhereItIs) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const PlaneDomain image = layers();
  {
    const LabelledComplex complex(mesh, image.label_of());
    EXPECT_TRUE(find_surface_defects(complex, image, 1).seeds.empty());
  }
  // A sample beyond the limit is uncovered, and the vertices next to it are known.
  std::vector<BoundarySample> samples = samples_on_plane();
  samples.push_back({{3, 3, 4.5F}, 1, 2});
  {
    const PlaneDomain more = layers(samples);
    const LabelledComplex complex(mesh, image.label_of());
    const DefectList defects = find_surface_defects(complex, more, 1);
    ASSERT_EQ(defects.seeds.size(), 1U);
    for (const VertexId v : defects.seeds[0]) {
      EXPECT_LE((mesh.points[v] - samples.back().centre()).norm(), 1.5);
    }
    DefectMeter meter(complex, more, 1);
    ASSERT_TRUE(meter.look_at(defects.seeds[0]));
    const DefectMeter::Scope scope = meter.scope_of(defects.seeds[0]);
    EXPECT_NEAR(meter.measure(scope).uncovered, 1.5, 1e-6);
    EXPECT_EQ(meter.uncovered_samples(scope).size(), 1U);
  }
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
  const LabelledComplex complex(mesh, image.label_of());
  const DefectList defects = find_surface_defects(complex, image, 1);
  ASSERT_EQ(defects.seeds.size(), 1U);
  EXPECT_EQ(defects.seeds[0], std::vector<VertexId>{tip});
  EXPECT_EQ(defects.self_intersections, 0U);
  DefectMeter meter(complex, image, 1);
  EXPECT_NEAR(meter.far({tip}), 2, 1e-9);  // one millimetre from the plane, of both
  EXPECT_EQ(meter.pinches({tip}), 0U);
}

TEST(SurfaceDefects, TooManySamplesAndVerticesAreNotLookedAt) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const std::vector<BoundarySample> many(20000000 / mesh.points.size() + 1, BoundarySample{{3, 3, 3}, 1, 2});
  const PlaneDomain image = layers(many);
  const LabelledComplex complex(mesh, image.label_of());
  const VertexId all_around = 0;
  EXPECT_TRUE(DefectMeter(complex, image, 0.1).look_at({&all_around, 1}));
  EXPECT_FALSE(DefectMeter(complex, image, 100).look_at({&all_around, 1}));
}

}  // namespace
}  // namespace cbc3d

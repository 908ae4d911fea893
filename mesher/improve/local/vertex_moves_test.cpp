// Moves of vertices towards the boundary.
#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace cbc3d

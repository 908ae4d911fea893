// Which boundary voxels have a vertex near, against searches through all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesher/domain/coverage.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(BoundaryCoverage, FindsWhatHasNoVertexOfItsMaterialNear) {
  const LabelImage image = testing::noisy_blocks_image(4, 3);
  std::mt19937 random(8);
  std::vector<Vec3> points;
  std::vector<SurfaceVertex> surface;
  for (VertexId v = 0; v < 60; ++v) {
    points.push_back({static_cast<double>(random() % 320) / 10, static_cast<double>(random() % 250) / 10,
                      static_cast<double>(random() % 310) / 10});
    surface.push_back({v, static_cast<MaterialId>(1 + random() % 4)});
  }
  BoundaryCoverage coverage(image);
  for (const double distance_mm : {3.0, 7.0}) {
    coverage.update(surface, points, distance_mm);
    std::size_t uncovered = 0;
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      const MaterialId own = image.voxels[v];
      if (own == kBackground || !is_boundary_voxel(image, at[0], at[1], at[2])) {
        continue;
      }
      const Vec3 centre = image.frame.local_centre(at[0], at[1], at[2]);
      const bool covered = std::any_of(surface.begin(), surface.end(), [&](const SurfaceVertex& s) {
        return s.material == own && (points[s.vertex] - centre).norm() <= distance_mm;
      });
      uncovered += covered ? 0 : 1;
      EXPECT_TRUE(covered || coverage.wants_refinement(at[1], at[2], at[0], at[0] + 1));
    }
    EXPECT_EQ(coverage.uncovered_count(), uncovered);
    EXPECT_GT(uncovered, 100U);
  }
}

TEST(InterfaceCoverage, AClosedGapBetweenTwoLabelsIsSeen) {
  // Two slabs one voxel apart. Vertices in the gap where both labels meet cover each label's boundary; the
  // interfaces towards background are missing all the same.
  const LabelImage image = testing::make_image({9, 5, 5}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.x < 4 ? 1 : p.x > 4 ? 2 : 0;
  });
  struct Vertices {
    std::vector<Vec3> points;
    std::vector<MaterialSet> sets;
  };
  Vertices closed;
  Vertices open;
  for (int j = 0; j < 5; ++j) {
    for (int k = 0; k < 5; ++k) {
      closed.points.push_back({4.0, static_cast<double>(j), static_cast<double>(k)});
      closed.sets.emplace_back();
      closed.sets.back().add(1);
      closed.sets.back().add(2);
    }
  }
  open.points = closed.points;
  open.sets = closed.sets;
  for (MaterialSet& set : open.sets) set.add(kBackground);
  const ImageDomain domain(image);
  InterfaceCoverage coverage(domain);
  coverage.update(open.sets, open.points, 1.1);
  const std::size_t elsewhere = coverage.uncovered_count();  // on the image's border
  EXPECT_FALSE(coverage.wants_refinement(2, 2, 3, 6));
  coverage.update(closed.sets, closed.points, 1.1);
  EXPECT_GT(coverage.uncovered_count(), elsewhere);
  EXPECT_TRUE(coverage.wants_refinement(2, 2, 3, 4));
  EXPECT_TRUE(coverage.wants_refinement(2, 2, 4, 5));
}

}  // namespace
}  // namespace cbc3d

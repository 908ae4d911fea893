// Which boundary voxels have a vertex near, against searches through all of them.
#include <gtest/gtest.h>

#include <vector>

#include "mesher/domain/coverage.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

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
  InterfaceCoverage coverage(image);
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

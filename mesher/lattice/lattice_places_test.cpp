// The coarse look-up of places passes over no tet that holds one.
#include <gtest/gtest.h>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/lattice_places.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::refine_at_random;

TEST(LatticePlaces, NoTetThatHoldsAPlaceIsPassedOver) {
  const LabelImage image = testing::make_image({40, 30, 20}, {0.9, 1.1, 1.3}, 1, [](const Vec3& p) {
    return (p - Vec3{18, 16, 13}).norm() < 11 ? 1 : 0;
  });
  Lattice lattice = build_bcc_lattice(image, {7.3, 0.5});
  refine_at_random(lattice, 3, 3, 8);
  const VoxelRaster raster(image.frame, lattice.frame);
  LatticePlaces places(image.frame, lattice.frame);
  for (const std::size_t voxel : {std::size_t{0}, std::size_t{12345}, image.voxels.size() - 1}) {
    const Index3 at = image.frame.index_of(voxel);
    places.clear();
    places.add(image.frame.local_centre(at[0], at[1], at[2]));
    std::size_t passed_over = 0;
    for (const RedTet& red : lattice.reds) {
      const bool may_hold = places.may_hold(lattice.points[red.nodes[0]], red.level);
      passed_over += may_hold ? 0 : 1;
      raster.for_each_row({lattice.points[red.nodes[0]], lattice.points[red.nodes[1]],
                           lattice.points[red.nodes[2]], lattice.points[red.nodes[3]]},
                          [&](int j, int k, int begin, int end) {
                            const bool holds = j == at[1] && k == at[2] && begin <= at[0] && at[0] < end;
                            EXPECT_TRUE(may_hold || !holds);
                          });
    }
    EXPECT_GT(passed_over, lattice.reds.size() / 2);
  }
}

}  // namespace
}  // namespace cbc3d

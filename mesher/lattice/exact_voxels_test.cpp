// Which voxels become exact, and which places lie in them.
#include "mesher/lattice/exact_voxels.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(ExactVoxels, APlaceTakesItsMisplacedNeighboursAlong) {
  ImageFrame frame;
  frame.size = {10, 8, 6};
  frame.spacing_mm = {1, 2, 3};
  ExactVoxels exact(frame);
  const auto is_exact = [&](int i, int j, int k) { return exact.holds(frame.local_centre(i, j, k)); };
  EXPECT_FALSE(is_exact(5, 4, 3));

  const std::size_t place = frame.offset(5, 4, 3);
  std::vector<std::size_t> misplaced = {frame.offset(4, 3, 2), frame.offset(3, 4, 3), place,
                                        frame.offset(6, 4, 3)};
  exact.add({place}, misplaced);
  EXPECT_TRUE(is_exact(5, 4, 3));
  EXPECT_TRUE(is_exact(6, 4, 3));
  EXPECT_TRUE(is_exact(4, 3, 2));   // across a corner
  EXPECT_FALSE(is_exact(3, 4, 3));  // two steps away
  EXPECT_FALSE(is_exact(5, 5, 3));  // beside it, but not misplaced

  // What comes again is stubborn, and only that.
  EXPECT_FALSE(exact.is_stubborn(frame.local_centre(5, 4, 3)));
  exact.add({place}, misplaced);
  EXPECT_TRUE(exact.is_stubborn(frame.local_centre(5, 4, 3)));
  EXPECT_FALSE(exact.is_stubborn(frame.local_centre(6, 4, 3)));

  // A place at the image's corner has fewer neighbours.
  exact.add({0}, {0, frame.offset(1, 1, 1)});
  EXPECT_TRUE(is_exact(0, 0, 0));
  EXPECT_TRUE(is_exact(1, 1, 1));
}

TEST(ExactVoxels, AVoxelEndsHalfWayToTheNext) {
  ImageFrame frame;
  frame.size = {4, 4, 4};
  frame.spacing_mm = {1, 2, 3};
  ExactVoxels exact(frame);
  exact.add({frame.offset(3, 1, 1)}, {});
  EXPECT_TRUE(exact.holds({3.49, 2.9, 3.9}));
  EXPECT_FALSE(exact.holds({2.49, 2, 3}));
  EXPECT_FALSE(exact.holds({3.51, 2, 3}));  // outside the image
  EXPECT_FALSE(exact.holds({-9, 2, 3}));
}

}  // namespace
}  // namespace cbc3d

#include "baselines/ld/strata.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines::ld {
namespace {

TEST(Strata, OfKnownNeighbourhoods) {
  EXPECT_EQ(stratum_of({3, 3, 3, 3, 3, 3, 3, 3}), Stratum::volume);
  EXPECT_EQ(stratum_of({1, 2, 1, 2, 1, 2, 1, 2}), Stratum::sheet);  // a plane
  EXPECT_EQ(stratum_of({1, 0, 0, 0, 0, 0, 0, 0}), Stratum::sheet);  // the corner of a box
  EXPECT_EQ(stratum_of({1, 1, 0, 1, 0, 0, 0, 1}), Stratum::sheet);  // steps
  EXPECT_EQ(stratum_of({1, 2, 3, 3, 1, 2, 3, 3}), Stratum::line);   // three materials along z
  EXPECT_EQ(stratum_of({1, 2, 3, 4, 1, 2, 3, 4}), Stratum::line);   // four
  EXPECT_EQ(stratum_of({1, 2, 3, 3, 0, 0, 0, 0}), Stratum::point);  // where such a line ends
  EXPECT_EQ(stratum_of({1, 2, 3, 4, 5, 6, 7, 8}), Stratum::point);
}

TEST(Strata, OfNonManifoldNeighbourhoods) {
  EXPECT_EQ(stratum_of({1, 0, 0, 1, 1, 0, 0, 1}), Stratum::line);   // an edge contact along z
  EXPECT_EQ(stratum_of({1, 0, 0, 0, 0, 0, 0, 1}), Stratum::point);  // a corner contact
  EXPECT_EQ(stratum_of({1, 0, 0, 1, 0, 0, 0, 0}), Stratum::point);  // where an edge contact ends
}

TEST(Strata, NormalAxesAreThoseOfTheFacesAtTheCorner) {
  EXPECT_EQ(normal_axes_of({3, 3, 3, 3, 3, 3, 3, 3}), 0);
  EXPECT_EQ(normal_axes_of({1, 2, 1, 2, 1, 2, 1, 2}), 1);
  EXPECT_EQ(normal_axes_of({1, 2, 3, 3, 1, 2, 3, 3}), 3);
  EXPECT_EQ(normal_axes_of({1, 0, 0, 0, 0, 0, 0, 0}), 7);
}

}  // namespace
}  // namespace cbc3d::baselines::ld

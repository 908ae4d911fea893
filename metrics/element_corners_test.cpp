#include "metrics/element_corners.hpp"

#include <gtest/gtest.h>

namespace cbc3d::metrics {
namespace {

constexpr std::array<Vec3, 8> kCube{
    {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}}};
constexpr std::array<Vec3, 6> kPrism{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
constexpr std::array<Vec3, 5> kPyramid{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}}};

double determinant(const Vec3& e1, const Vec3& e2, const Vec3& e3) {
  return e1.dot(e2.cross(e3));
}

TEST(ElementCorners, EdgesAreRightHandedAtEveryCornerOfAPositiveCell) {
  EXPECT_EQ(smallest_at_corners(kHexCorners, kCube, determinant), 8);
  EXPECT_EQ(smallest_at_corners(kWedgeCorners, kPrism, determinant), 1);
  EXPECT_EQ(smallest_at_corners(kPyramidBaseCorners, kPyramid, determinant), 12);
  EXPECT_EQ(smallest_at_corners(kPyramidApexCorners, kPyramid, determinant), 12);
}

TEST(ElementCorners, EveryNodeIsACornerOnce) {
  for (std::size_t n = 0; n < kHexCorners.size(); ++n) {
    EXPECT_EQ(kHexCorners[n].at, n);
  }
  for (std::size_t n = 0; n < kWedgeCorners.size(); ++n) {
    EXPECT_EQ(kWedgeCorners[n].at, n);
  }
  for (std::size_t n = 0; n < kPyramidBaseCorners.size(); ++n) {
    EXPECT_EQ(kPyramidBaseCorners[n].at, n);
    EXPECT_EQ(kPyramidApexCorners[n].at, 4U);
  }
}

TEST(ElementCorners, TheCornerThatIsPushedInIsTheSmallest) {
  std::array<Vec3, 8> dented = kCube;
  dented[6] = {0.5, 0.5, 0.5};  // through the plane of its three neighbours
  EXPECT_LT(smallest_at_corners(kHexCorners, dented, determinant), 0);
}

TEST(ElementCorners, PositionsFollowTheNodesOfTheCell) {
  const std::vector<Vec3> points{{9, 9, 9}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  const std::array<VertexId, 4> nodes{4, 2, 3, 1};
  const auto p = node_positions<4>({CellKind::kTet, nodes}, points);
  EXPECT_EQ(p, (std::array<Vec3, 4>{{{4, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}}}));
}

}  // namespace
}  // namespace cbc3d::metrics

#include "baselines/ld/leaf_templates.hpp"

#include <gtest/gtest.h>

#include "baselines/ld/dihedral.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::ld {
namespace {

TEST(Dihedral, OfTheCornerOfACubeAndOfTheRegularTet) {
  EXPECT_NEAR(least_dihedral_deg({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), std::acos(std::sqrt(1.0 / 3)) * 180 / M_PI,
              1e-12);
  EXPECT_NEAR(least_dihedral_deg({1, 1, 0}, {1, 0, 1}, {0, 1, 1}), std::acos(1.0 / 3) * 180 / M_PI, 1e-12);
}

TEST(Dihedral, BoundsAreKeptOnBothSides) {
  const Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};  // angles of 54.7 and 90 degrees
  EXPECT_TRUE(DihedralBounds(54.73, 180).accept(a, b, c));
  EXPECT_FALSE(DihedralBounds(54.74, 180).accept(a, b, c));
  EXPECT_TRUE(DihedralBounds(0, 90.01).accept(a, b, c));
  const Vec3 flat{0.4, 0.4, 0.1};
  EXPECT_TRUE(DihedralBounds(0, 180).accept(a, b, flat));
  EXPECT_FALSE(DihedralBounds(0, 121).accept(a, b, flat));
}

TEST(LeafTemplates, TheirSmallestAngleIs45DegreesForCubes) {
  EXPECT_NEAR(least_template_dihedral_deg({1, 1, 1}), 45, 1e-9);
  EXPECT_NEAR(least_template_dihedral_deg({0.3, 0.3, 0.3}), 45, 1e-9);
  EXPECT_LT(least_template_dihedral_deg({1, 1, 2}), 45);
}

TEST(LeafTemplates, ElongatedVoxelsAreCutWhereTheBoundAsksForIt) {
  EXPECT_EQ(pieces_for({1, 1, 1}, 15), (Index3{1, 1, 1}));
  EXPECT_EQ(pieces_for({0.7, 0.7, 1.6}, 15), (Index3{1, 1, 1}));
  const Index3 pieces = pieces_for({1, 1, 10}, 15);
  EXPECT_GT(pieces[2], 1);
  EXPECT_GE(least_template_dihedral_deg({1, 1, 10.0 / pieces[2]}), 15);
  EXPECT_THROW(pieces_for({1, 1, 1}, 45.1), InputError);
}

// A block with one split neighbour box: faces of all kinds occur.
TEST(LeafTemplates, EveryLeafIsFilledWithPositiveTets) {
  const LabelImage image =
      testing::make_image({16, 16, 16}, {1, 1, 1}, 1, [](const Vec3& p) { return p.norm() < 3.2 ? 1 : 0; });
  const CellGrid grid(image, {.block = 16});
  const LabelOctree octree(grid);
  std::vector<Leaf> leaves;
  octree.append_leaves({0, 0, 0}, leaves);
  std::size_t fans = 0;
  for (const Leaf& leaf : leaves) {
    std::vector<LeafTriangle> triangles;
    append_leaf_triangles(octree, leaf, triangles);
    std::int64_t volume = 0;
    for (const LeafTriangle& t : triangles) {
      const std::int64_t six = orientation(t.corners[0], t.corners[1], t.corners[2], centre_of(leaf));
      EXPECT_GT(six, 0);
      volume += six;
    }
    EXPECT_EQ(volume, std::int64_t{6} * 8 << 3 * leaf.level);
    fans += triangles.size() != 12 ? 1 : 0;
  }
  EXPECT_GT(fans, 0U);
}

}  // namespace
}  // namespace cbc3d::baselines::ld

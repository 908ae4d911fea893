#include "baselines/cleaver/tet_angles.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines::cleaver {
namespace {

TEST(TetAngles, TheBodyCentredTetHas60And90Degrees) {
  const std::array<Vec3, 4> tet{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 0.5, -0.5}, Vec3{0.5, 0.5, 0.5}};
  const CosineRange range = dihedral_cosines(tet);
  EXPECT_NEAR(range.least, 0, 1e-12);
  EXPECT_NEAR(range.most, 0.5, 1e-12);
  EXPECT_NEAR(worst_cosine(tet), 0.5, 1e-12);
  EXPECT_TRUE(has_angles_within(tet, 59, 91));
  EXPECT_FALSE(has_angles_within(tet, 61, 91));
  EXPECT_FALSE(has_angles_within(tet, 59, 89));
}

TEST(TetAngles, FlatAndInvertedTetsAreWorst) {
  EXPECT_EQ(worst_cosine({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}), 2);
  EXPECT_EQ(worst_cosine({Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}), 2);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver

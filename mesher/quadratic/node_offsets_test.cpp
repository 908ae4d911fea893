// Offsets against volumes and areas whose answer is known.
#include "mesher/quadratic/node_offsets.hpp"

#include <gtest/gtest.h>

#include "mesher/domain/image_domain.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// A ball with a core, and areas of their surfaces that differ by much.
class NodeOffsetsTest : public ::testing::Test {
 protected:
  /// What the domain wants, less what each material is to gain.
  [[nodiscard]] std::vector<double> volumes_that_lack(double first_mm3, double second_mm3) const {
    const std::vector<double>& wanted = domain_.volumes_mm3();
    return {0, wanted[1] - first_mm3, wanted[2] - second_mm3};
  }

  const LabelImage image_ = testing::ball_image(32, 1, 12, 6);
  const ImageDomain domain_{image_};
  const std::vector<OffsetArea> areas_{{0, 1, 1800}, {1, 2, 450}};
  NodeOffsets offsets_{domain_};
};

TEST_F(NodeOffsetsTest, GiveEveryMaterialWhatItLacks) {
  offsets_.update(volumes_that_lack(90, -45), areas_);
  // The outer surface gains for both what the core's gives away.
  EXPECT_NEAR(offsets_.between_mm(0, 1), -45.0 / 1800, 1e-9);
  EXPECT_NEAR(offsets_.between_mm(1, 2), 45.0 / 450, 1e-9);
  EXPECT_EQ(offsets_.between_mm(1, 0), -offsets_.between_mm(0, 1));
  offsets_.update(volumes_that_lack(0, 45), areas_);
  EXPECT_NEAR(offsets_.between_mm(0, 1), -45.0 / 1800 - 45.0 / 1800, 1e-9);
  EXPECT_NEAR(offsets_.between_mm(1, 2), 0, 1e-9);
}

TEST_F(NodeOffsetsTest, AreNeverMoreThanHalfAVoxel) {
  offsets_.update(volumes_that_lack(1e4, -1e4), areas_);
  EXPECT_DOUBLE_EQ(offsets_.between_mm(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(offsets_.between_mm(2, 0), -0.5);
}

TEST_F(NodeOffsetsTest, EndWhereAnUpdateDoesNotHalveTheError) {
  EXPECT_FALSE(offsets_.can_improve(volumes_that_lack(0, 0), areas_));
  EXPECT_TRUE(offsets_.can_improve(volumes_that_lack(0, 8), areas_));
  EXPECT_FALSE(offsets_.can_improve(volumes_that_lack(0, 8), {{0, 1, 1800}, {1, 2, 0}}));
  offsets_.update(volumes_that_lack(0, 8), areas_);
  EXPECT_TRUE(offsets_.can_improve(volumes_that_lack(0, 3.9), areas_));
  EXPECT_FALSE(offsets_.can_improve(volumes_that_lack(0, 4.1), areas_));
  EXPECT_TRUE(offsets_.can_improve(volumes_that_lack(1, 4.1), areas_));  // the first had no error before
}

}  // namespace
}  // namespace cbc3d

#include "mesher/core/frame_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

std::string refusal_of(ImageFrame frame) {
  try {
    require_usable_frame(frame, "'a.nrrd'");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FrameCheck, ASignedPermutationStaysToTheLastDigit) {
  ImageFrame frame;
  frame.direction = Mat3::from_columns({0, -1, 0}, {0, 0, 1}, {1, 0, 0});
  const Mat3 before = frame.direction;
  require_usable_frame(frame, "'a.nrrd'");
  for (int column = 0; column < 3; ++column) {
    EXPECT_EQ(frame.direction.column(column), before.column(column));
  }
}

TEST(FrameCheck, RoundedDirectionsBecomeOrthonormalAndKeepTheirHandedness) {
  for (const double side : {1.0, -1.0}) {
    ImageFrame frame;
    frame.direction = Mat3::from_columns({0.866, 0.5, 0}, {-0.5, 0.866, 0}, {0, 0, side});
    require_usable_frame(frame, "'a.nrrd'");
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        EXPECT_NEAR(frame.direction.column(a).dot(frame.direction.column(b)), a == b ? 1 : 0, 1e-15);
      }
    }
    EXPECT_NEAR(frame.direction.determinant(), side, 1e-15);
  }
}

TEST(FrameCheck, RefusesWhatNoFrameExpresses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double spacing : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    ImageFrame frame;
    frame.spacing_mm = {1, spacing, 1};
    EXPECT_NE(refusal_of(frame).find("'a.nrrd': its spacing"), std::string::npos) << spacing;
  }
  ImageFrame nowhere;
  nowhere.origin_mm = {0, 0, nan};
  EXPECT_NE(refusal_of(nowhere), "");
  ImageFrame sheared;
  sheared.direction = Mat3::from_columns({1, 0, 0}, {0.1, 1, 0}, {0, 0, 1});
  EXPECT_NE(refusal_of(sheared).find("sheared by 0.0995"), std::string::npos) << refusal_of(sheared);
  ImageFrame singular;
  singular.direction = Mat3::from_columns({1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_NE(refusal_of(singular).find("singular"), std::string::npos);
  ImageFrame needle;
  needle.spacing_mm = {1, 1, 1e-4};
  EXPECT_NE(refusal_of(needle).find("1e+04 times as long as thick"), std::string::npos) << refusal_of(needle);
}

TEST(FrameCheck, AnAcceptedShearBecomesTheNearestFrameAroundTheSameCentre) {
  ImageFrame frame;
  frame.size = {11, 21, 31};
  frame.origin_mm = {5, 6, 7};
  frame.direction = Mat3::from_columns({1, 0, 0}, {0.1, 1, 0}, {0, 0, -1});
  const Mat3 unit = Mat3::from_columns(frame.direction.column(0), frame.direction.column(1).normalized(),
                                       frame.direction.column(2));
  frame.direction = unit;
  const Vec3 centre = frame.to_physical(frame.local_centre(5, 10, 15));
  std::vector<std::string> warnings;
  require_usable_frame(frame, "'a.nrrd'", true, &warnings);
  EXPECT_LT((frame.to_physical(frame.local_centre(5, 10, 15)) - centre).norm(), 1e-12);
  EXPECT_NEAR(frame.direction.determinant(), -1, 1e-14);
  // The orthogonal factor Q of D = Q P leaves P = Q^T D symmetric.
  const Mat3 symmetric = frame.direction.transposed() * unit;
  EXPECT_NEAR(symmetric(0, 1), symmetric(1, 0), 1e-14);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("sheared by 0.0995"), std::string::npos);
}

TEST(FrameCheck, ASmallShearIsTakenAsItIs) {
  for (const double shear : {2e-4, 9e-4}) {
    ImageFrame frame;
    frame.direction = Mat3::from_columns({1, 0, 0}, {shear, 1, 0}, {0, 0, 1});
    EXPECT_EQ(refusal_of(frame), "") << shear;
  }
}

}  // namespace
}  // namespace cbc3d

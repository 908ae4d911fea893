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
  EXPECT_NE(refusal_of(sheared).find("sheared or singular"), std::string::npos);
  ImageFrame singular;
  singular.direction = Mat3::from_columns({1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_NE(refusal_of(singular), "");
}

}  // namespace
}  // namespace cbc3d

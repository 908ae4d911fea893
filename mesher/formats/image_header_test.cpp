#include "mesher/formats/image_header.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::formats {
namespace {

ImageHeader sound() {
  ImageHeader header;
  header.size = {2, 3, 4};
  header.component = Component::int16;
  return header;
}

TEST(ImageHeader, CountsBytesWithoutWrapping) {
  EXPECT_EQ(voxel_bytes(sound()), 48U);
  ImageHeader huge = sound();
  huge.size = {1U << 30U, 1U << 30U, 2};
  huge.component = Component::float64;
  EXPECT_THROW(voxel_bytes(huge), FormatError);
}

TEST(ImageHeader, SoundMeansFiniteAndWithinBounds) {
  EXPECT_NO_THROW(require_sound(sound()));
  for (const double spacing : {0.0, -1.0, 1e-300, 1e7, HUGE_VAL, std::nan("")}) {
    ImageHeader header = sound();
    header.spacing_mm[1] = spacing;
    EXPECT_THROW(require_sound(header), FormatError) << spacing;
  }
  for (const double origin : {1e10, -HUGE_VAL, std::nan("")}) {
    ImageHeader header = sound();
    header.origin_mm[2] = origin;
    EXPECT_THROW(require_sound(header), FormatError) << origin;
  }
  ImageHeader header = sound();
  header.axes[0][0] = std::nan("");
  EXPECT_THROW(require_sound(header), FormatError);
  header = sound();
  header.size[0] = 0;
  EXPECT_THROW(require_sound(header), FormatError);
  header = sound();
  header.slope = HUGE_VAL;
  EXPECT_THROW(require_sound(header), FormatError);
}

TEST(ImageHeader, StepsAreSpacingTimesDirection) {
  ImageHeader header = sound();
  set_steps(header, {{{0, 2, 0}, {3, 0, 0}, {0, 0, -4}}}, "steps");
  EXPECT_EQ(header.spacing_mm, (Triple{2, 3, 4}));
  EXPECT_EQ(header.axes[2], (Triple{0, 0, -1}));
  EXPECT_THROW(set_steps(header, {{{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}}, "steps"), FormatError);
  EXPECT_EQ(bytes_of(Component::float64), 8U);
  EXPECT_TRUE(is_floating(Component::float32));
  EXPECT_FALSE(is_floating(Component::int64));
}

}  // namespace
}  // namespace cbc3d::formats

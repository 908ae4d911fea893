#include "mesher/formats/units.hpp"

#include <gtest/gtest.h>

namespace cbc3d::formats {
namespace {

TEST(Units, AreKnownBySeveralNames) {
  for (const char* name : {"um", "\xC2\xB5m", "micron", "microns", "Micrometers", "micrometre"}) {
    EXPECT_EQ(millimetres_of(name), 1e-3) << name;
  }
  EXPECT_EQ(millimetres_of(" mm "), 1);
  EXPECT_EQ(millimetres_of("m"), 1000);
  EXPECT_EQ(millimetres_of("cm"), 10);
  EXPECT_FALSE(millimetres_of("furlong").has_value());
  EXPECT_FALSE(millimetres_of("").has_value());
}

}  // namespace
}  // namespace cbc3d::formats

#include "mesher/formats/binary_header.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace cbc3d::formats {
namespace {

TEST(BinaryHeader, ReadsEitherByteOrder) {
  const std::string_view bytes("\x01\x02\x03\x04", 4);
  EXPECT_EQ(BinaryHeader(bytes, true).get<std::uint16_t>(1), 0x0203);
  EXPECT_EQ(BinaryHeader(bytes, false).get<std::uint16_t>(1), 0x0302);
  EXPECT_EQ(BinaryHeader(bytes, true).get<std::uint32_t>(0), 0x01020304U);
}

}  // namespace
}  // namespace cbc3d::formats

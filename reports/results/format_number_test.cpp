#include "reports/results/format_number.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(FormatNumber, HasCommasBetweenThousands) {
  EXPECT_EQ(format_number(0, 0), "0");
  EXPECT_EQ(format_number(999, 0), "999");
  EXPECT_EQ(format_number(-1234567.891, 2), "-1,234,567.89");
}

}  // namespace
}  // namespace cbc3d::reports

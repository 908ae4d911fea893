#include "reports/statistics/holm.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(Holm, AdjustsAsInTheTextbook) {
  // .01, .04, .03, .005: compared with .05/4, .05/3, .05/2 and .05 in turn, .005 and .01 are rejected.
  const std::vector<double> adjusted = holm_adjusted({0.01, 0.04, 0.03, 0.005});
  ASSERT_EQ(adjusted.size(), 4U);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.02);
}

TEST(Holm, StaysAtMostOne) {
  EXPECT_EQ(holm_adjusted({0.9, 0.8}), (std::vector<double>{1, 1}));
  EXPECT_TRUE(holm_adjusted({}).empty());
  EXPECT_EQ(holm_adjusted({0.2}), (std::vector<double>{0.2}));
}

}  // namespace
}  // namespace cbc3d::reports

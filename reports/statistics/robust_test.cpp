#include "reports/statistics/robust.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::reports {
namespace {

TEST(Robust, AreThoseOfTheTextbook) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_NEAR(spread({1, 2, 3, 4, 100}), 1.4826, 1e-9);
  EXPECT_EQ(median_error({7}), 0);
  EXPECT_NEAR(median_error({1, 2, 3, 4, 5}), 1.2533 * 1.4826 / std::sqrt(5.0), 1e-9);
  EXPECT_EQ(outliers({1, 2, 90}), std::vector<bool>(3, false));
  EXPECT_EQ(outliers({1, 1.1, 0.9, 1, 90}), (std::vector<bool>{false, false, false, false, true}));
}

}  // namespace
}  // namespace cbc3d::reports

#include "reports/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cbc3d::reports {
namespace {

std::vector<double> lognormal(std::size_t count, double median, std::mt19937_64& random) {
  std::lognormal_distribution<double> draw(std::log(median), 0.3);
  std::vector<double> values(count);
  for (double& value : values) value = draw(random);
  return values;
}

/// The share of 400 samples whose interval, by `interval_of`, holds `truth`.
template <class IntervalOf>
double coverage(double truth, IntervalOf interval_of) {
  std::mt19937_64 random(7);
  constexpr int kTrials = 400;
  int holding = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Interval interval = interval_of(random).value();
    holding += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  return static_cast<double>(holding) / kTrials;
}

TEST(Bootstrap, IntervalsOfMediansHoldTheTrueOneAsOftenAsTheySay) {
  // 400 trials of a share of .95 have a standard error of .011. Of 10 values the interval cannot have every
  // level, and percentiles lie between the order statistics whose intervals hold .89 and .98.
  const double held = coverage(2, [](auto& random) { return median_interval(lognormal(10, 2, random)); });
  EXPECT_GT(held, 0.91);
  EXPECT_LT(held, 0.99);
}

TEST(Bootstrap, IntervalsOfRatiosToo) {
  const double held = coverage(1.5, [](auto& random) {
    const auto above = lognormal(10, 3, random);
    return median_ratio_interval(above, lognormal(10, 2, random));
  });
  EXPECT_GT(held, 0.91);
  EXPECT_LT(held, 0.995);
}

TEST(Bootstrap, TheSameSeedGivesTheSameInterval) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(median_interval(values), median_interval(values));
  EXPECT_EQ(median_interval({5, 5, 5, 5, 5, 5}), (Interval{5, 5}));
}

TEST(Bootstrap, ALowerLevelIsNarrower) {
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const Interval wide = median_interval(values, 0.99).value(), narrow = median_interval(values, 0.5).value();
  EXPECT_LT(wide.low, narrow.low);
  EXPECT_GT(wide.high, narrow.high);
}

TEST(Bootstrap, TooFewValuesHaveNoInterval) {
  EXPECT_EQ(fewest_for_interval(0.95), 6U);  // 1 - 2/32 is below .95, 1 - 2/64 above
  EXPECT_EQ(fewest_for_interval(0.5), 2U);
  EXPECT_FALSE(median_interval({1, 2, 3, 4, 5}).has_value());
  EXPECT_FALSE(median_ratio_interval({1, 2, 3, 4, 5, 6}, {1, 2, 3}).has_value());
}

TEST(Bootstrap, NothingIsDividedByZero) {
  EXPECT_FALSE(median_ratio_interval({1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5}).has_value());
}

}  // namespace
}  // namespace cbc3d::reports

#include "reports/statistics/comparison.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

const std::vector<double> kLow{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9};
const std::vector<double> kHigh{2.0, 2.1, 2.2, 2.3, 2.4, 2.5, 2.6, 2.7, 2.8, 2.9};
const std::vector<double> kLikeLow{1.05, 1.08, 1.25, 1.28, 1.45, 1.48, 1.65, 1.68, 1.85, 1.88};

TEST(Comparison, SaysWhichIsLargerAndHowMuch) {
  const auto found = compare_samples({{kHigh, kLow}, {kLow, kHigh}, {kLikeLow, kLow}}, 0.05);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[0].ratio.value(), 2.45 / 1.45);
  EXPECT_LT(found[0].ratio_interval.value().low, 2.45 / 1.45);
  EXPECT_GT(found[0].ratio_interval.value().high, 2.45 / 1.45);
  EXPECT_EQ(time_finding(found[0]), "slower, A 1.00");
  EXPECT_EQ(time_finding(found[1]), "faster, A 0.00");
  EXPECT_EQ(time_finding(found[2]).substr(0, 17), "not told apart, A");
}

TEST(Comparison, HolmsCorrectionCountsAllTestsOfTheFamily) {
  const std::vector<double> three{1, 2, 3, 4}, above{5, 6, 7, 8};  // p is 2/70
  EXPECT_EQ(compare_samples({{above, three}}, 0.05)[0].finding, Finding::larger);
  const auto two = compare_samples({{above, three}, {three, three}}, 0.05);
  EXPECT_NEAR(two[0].adjusted_p, 4.0 / 70, 1e-12);
  EXPECT_EQ(two[0].finding, Finding::too_few);
}

TEST(Comparison, FewRunsTellNothingHoweverFarApart) {
  const auto found = compare_samples({{{9, 10, 11}, {1, 2, 3}}, {{}, {1}}}, 0.05);
  EXPECT_EQ(time_finding(found[0]), "too few runs to tell");
  EXPECT_FALSE(found[0].ratio_interval.has_value());
  EXPECT_FALSE(found[1].ratio.has_value());
  EXPECT_EQ(found[1].finding, Finding::too_few);
  EXPECT_NEAR(found[0].adjusted_p, 0.1, 1e-12);  // the pair without values is no test
}

TEST(Comparison, EqualSamplesAreNotToldApart) {
  const auto found = compare_samples({{kLow, kLow}}, 0.05);
  EXPECT_EQ(time_finding(found[0]), "not told apart, A 0.50");
}

}  // namespace
}  // namespace cbc3d::reports

#include "metrics/order_statistics.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace cbc3d::metrics {
namespace {

constexpr std::array<std::size_t, 5> kRanks{0, 1, 10, 500, 1000};

TEST(OrderStatistics, AreNearestRanks) {
  std::vector<int> values(2000);  // 1 to 2000, shuffled
  for (int n = 0; n < 2000; ++n) values[static_cast<std::size_t>(n)] = (n * 777) % 2000 + 1;
  const auto found = order_statistics(std::span(values), kRanks);
  ASSERT_TRUE(found);
  EXPECT_EQ(found.value(), (std::array<double, 5>{1, 2, 20, 1000, 2000}));
}

TEST(OrderStatistics, OfFewValues) {
  std::vector<double> one{3};
  EXPECT_EQ(order_statistics(std::span(one), kRanks).value(), (std::array<double, 5>{3, 3, 3, 3, 3}));
  std::vector<double> none;
  EXPECT_FALSE(order_statistics(std::span(none), kRanks));
}

TEST(OrderStatistics, AgreeWithSorting) {
  std::mt19937 random(7);
  for (std::size_t size = 1; size < 300; size += 13) {
    std::vector<double> values(size);
    for (double& v : values) v = static_cast<double>(random() % 50);
    std::vector<double> sorted(values);
    std::sort(sorted.begin(), sorted.end());
    const auto found = order_statistics(std::span(values), kRanks);
    for (std::size_t r = 0; r < kRanks.size(); ++r) {
      // The smallest value that at least so many per mille do not exceed.
      std::size_t first = 0;
      while (1000 * (first + 1) < kRanks[r] * size) ++first;
      EXPECT_EQ(found.value()[r], sorted[first]) << size << " " << kRanks[r];
    }
  }
}

TEST(OrderStatistics, ShareBelow) {
  const std::vector<double> values{.1, .2, .3, .4};
  EXPECT_EQ(percent_below(std::span(values), .3), 50);
  EXPECT_EQ(percent_below(std::span<const double>(), .3), 0);
}

}  // namespace
}  // namespace cbc3d::metrics

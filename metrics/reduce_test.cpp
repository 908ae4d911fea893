#include "metrics/reduce.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesher/core/runtime.hpp"

namespace cbc3d::metrics {
namespace {

std::vector<double> sums(int threads) {
  set_thread_count(threads);
  const auto totals = ordered_sums<double>(100'000, 2, [](std::size_t n, std::vector<double>& slots) {
    slots[n % 2] += 1.0 / static_cast<double>(n + 1);
  });
  set_thread_count(0);
  return totals;
}

TEST(Reduce, SumsAreTheSameBytesAtAnyThreadCount) {
  const std::vector<double> one = sums(1);
  EXPECT_EQ(one, sums(2));
  EXPECT_EQ(one, sums(3));
  double odd = 0;
  for (int n = 1; n < 100'000; n += 2) odd += 1.0 / (n + 1);
  EXPECT_NEAR(one[1], odd, 1e-9);
}

TEST(Reduce, OfNothingIsZero) {
  EXPECT_EQ(ordered_sums<int>(0, 3, [](std::size_t, std::vector<int>&) {}), (std::vector<int>{0, 0, 0}));
}

TEST(Reduce, AFigureThatCannotBeHadIsNull) {
  EXPECT_TRUE(number_or_null(std::nullopt).is_null());
  EXPECT_TRUE(number_or_null(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(number_or_null(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_EQ(number_or_null(1.5), 1.5);
}

TEST(Reduce, TheLargerOfTwoIsTheOneThatIsThere) {
  EXPECT_EQ(max_of(1.0, 2.0), 2.0);
  EXPECT_EQ(max_of(std::nullopt, -1.0), -1.0);
  EXPECT_EQ(max_of(3.0, std::nullopt), 3.0);
  EXPECT_FALSE(max_of(std::nullopt, std::nullopt).has_value());
}

}  // namespace
}  // namespace cbc3d::metrics

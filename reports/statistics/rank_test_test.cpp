#include "reports/statistics/rank_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace cbc3d::reports {
namespace {

TEST(MannWhitney, GivesTheFiguresOfScipysDocumentation) {
  // The example of scipy.stats.mannwhitneyu: ages at which a diabetes was found, men and women.
  const std::vector<double> men{19, 22, 16, 29, 24}, women{20, 11, 17, 12};
  EXPECT_NEAR(mann_whitney_p(men, women), 0.1111111111111111, 1e-14);
  EXPECT_NEAR(mann_whitney_normal_p(men, women), 0.11134688653314041, 1e-14);
  EXPECT_NEAR(vargha_delaney_a(men, women), 17.0 / 20, 1e-14);
}

TEST(MannWhitney, ReachesTheBinomialsLeastP) {
  const std::vector<double> low{1, 2, 3}, high{4, 5, 6};
  EXPECT_NEAR(mann_whitney_p(low, high), 0.1, 1e-14);  // Mann and Whitney's table: 1/20 at each end
  EXPECT_NEAR(smallest_mann_whitney_p(3, 3), 0.1, 1e-14);
  EXPECT_NEAR(smallest_mann_whitney_p(10, 10), 2.0 / 184756, 1e-18);
  EXPECT_EQ(smallest_mann_whitney_p(1, 1), 1);
}

/// Twice the smaller tail over all choices, counted one by one.
double counted_p(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all(a);
  all.insert(all.end(), b.begin(), b.end());
  std::vector<bool> chosen(all.size(), false);
  std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(a.size()), true);
  const double seen = vargha_delaney_a(a, b);
  double below = 0, above = 0, count = 0;
  do {
    std::vector<double> x, y;
    for (std::size_t n = 0; n < all.size(); ++n) (chosen[n] ? x : y).push_back(all[n]);
    const double now = vargha_delaney_a(x, y);
    below += now <= seen + 1e-12 ? 1 : 0;
    above += now >= seen - 1e-12 ? 1 : 0;
    ++count;
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return std::min(1.0, 2 * std::min(below, above) / count);
}

TEST(MannWhitney, CountsThePermutationsWithTies) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> value(0, 4), size(1, 6);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<double> a(static_cast<std::size_t>(size(random))), b(static_cast<std::size_t>(size(random)));
    for (double& x : a) x = value(random);
    for (double& y : b) y = value(random);
    EXPECT_NEAR(mann_whitney_p(a, b), counted_p(a, b), 1e-12) << trial;
  }
}

TEST(MannWhitney, TheNormalDistributionTakesOverWithoutAStep) {
  std::vector<double> a, b;
  for (int n = 0; n < 25; ++n) {
    a.push_back(n);
    b.push_back(n + 4.5);
  }
  EXPECT_NEAR(mann_whitney_p(a, b), mann_whitney_normal_p(a, b), 0.002);
  a.push_back(25);
  EXPECT_EQ(mann_whitney_p(a, b), mann_whitney_normal_p(a, b));
}

TEST(MannWhitney, EqualAndEmptySamplesTellNothing) {
  EXPECT_EQ(mann_whitney_p({2, 2, 2}, {2, 2}), 1);
  EXPECT_EQ(mann_whitney_normal_p({2, 2, 2}, {2, 2}), 1);
  EXPECT_EQ(mann_whitney_p({}, {1}), 1);
  EXPECT_EQ(vargha_delaney_a({2, 2}, {2}), 0.5);
  EXPECT_EQ(vargha_delaney_a({}, {2}), 0.5);
}

TEST(MannWhitney, ChanceFindsAreAsRareAsTheLevel) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> draw;
  constexpr int kTrials = 2000;
  int found = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a(10), b(10);
    for (double& x : a) x = draw(random);
    for (double& y : b) y = draw(random);
    found += mann_whitney_p(a, b) <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(found, 0.05 * kTrials + 30);  // three standard errors
  EXPECT_GE(found, 0.03 * kTrials);       // an exact test of whole counts stays a little below its level
}

TEST(VarghaDelaney, IsOneWhereAllAreLarger) {
  EXPECT_EQ(vargha_delaney_a({5, 6}, {1, 2}), 1);
  EXPECT_EQ(vargha_delaney_a({1, 2}, {5, 6}), 0);
  EXPECT_EQ(vargha_delaney_a({1, 3}, {2, 3}), 0.375);
}

}  // namespace
}  // namespace cbc3d::reports

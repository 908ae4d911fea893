#include "reports/run/dial_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cbc3d::reports {
namespace {

using baselines::SizeDial;
using Mesher = std::function<double(double value)>;  // elements; 0: no mesh

const SizeDial kLength{.parameter = "size", .exponent = -2.5, .first = 2, .lowest = 0.01, .highest = 100};

DialSearch searched(const SizeDial& dial, double budget, const Mesher& mesher,
                    const std::vector<DialTry>& known = {}) {
  DialSearch search(dial, budget, known);
  int tries = 0;
  while (const auto value = search.next()) {
    EXPECT_GE(*value, dial.lowest);
    EXPECT_LE(*value, dial.highest);
    const auto elements = mesher(*value);
    search.add({*value, elements, elements > 0 ? "" : "too large"});
    ++tries;
  }
  EXPECT_LE(tries, kMostTries);
  return search;
}

TEST(DialSearch, MeetsBudgetsOfPowerLaws) {
  for (const double exponent : {-1.5, -2.0, -2.5, -3.0, -4.0}) {
    for (const double budget : {25e3, 100e3, 400e3}) {
      const Mesher mesher = [&](double value) { return 3e5 * std::pow(value, exponent); };
      const DialSearch search = searched(kLength, budget, mesher);
      EXPECT_TRUE(search.is_met()) << exponent << " " << budget;
      EXPECT_NEAR(search.best()->elements, budget, kBudgetTolerance * budget);
      EXPECT_EQ(search.reason(), "");
    }
  }
}

TEST(DialSearch, AKnownTryThatMeetsTheBudgetIsEnough) {
  const DialSearch search(kLength, 1000, {{3, 5000, ""}, {4, 950, ""}});
  EXPECT_EQ(search.next(), std::nullopt);
  EXPECT_EQ(search.best()->value, 4);
}

TEST(DialSearch, KnownTriesShortenTheSearch) {
  const Mesher mesher = [](double value) { return 1e6 * std::pow(value, -2.0); };
  const std::vector<DialTry> known{{1, 1e6, ""}, {2, 2.5e5, ""}};
  const DialSearch search = searched(kLength, 1e4, mesher, known);
  EXPECT_TRUE(search.is_met());
  EXPECT_LE(search.tries().size(), known.size() + 2);
}

TEST(DialSearch, ACountOfElementsIsAskedForAsItIs) {
  const SizeDial count{.parameter = "elements", .exponent = 1, .highest = 1e9, .counts_elements = true};
  EXPECT_EQ(DialSearch(count, 50000).next(), 50000);
  const DialSearch search = searched(count, 50000, [](double value) { return 0.8 * value; });
  EXPECT_TRUE(search.is_met());
  EXPECT_EQ(search.tries().size(), 2U);
}

TEST(DialSearch, AFloorOfTheImageIsSaidAfterFewTries) {
  const DialSearch search =
      searched(kLength, 1000, [](double value) { return 80000 + 100 * std::pow(value, -3.0); });
  EXPECT_FALSE(search.is_met());
  EXPECT_LE(search.tries().size(), 3U);
  EXPECT_NE(search.reason().find("no fewer than 80,000 elements at size="), std::string::npos)
      << search.reason();
}

TEST(DialSearch, AFloorThatAnotherBudgetFoundIsLeft) {
  const auto with_floor = [](double elements) { return std::max(76186.0, elements); };
  const SizeDial count{.parameter = "elements", .exponent = 1, .highest = 1e9, .counts_elements = true};
  const DialSearch low = searched(count, 25000, with_floor);
  EXPECT_FALSE(low.is_met());
  for (const double budget : {100e3, 400e3}) {
    EXPECT_TRUE(searched(count, budget, with_floor, low.tries()).is_met()) << budget;
  }
  const Mesher lengths = [&](double value) { return with_floor(1e6 * std::pow(value, -2.5)); };
  const DialSearch coarse = searched(kLength, 25000, lengths);
  EXPECT_FALSE(coarse.is_met());
  EXPECT_TRUE(searched(kLength, 400e3, lengths, coarse.tries()).is_met());
}

TEST(DialSearch, ACeilingByFailuresIsSaidWithThem) {
  const DialSearch search =
      searched(kLength, 1e6, [](double value) { return value < 1 ? 0 : 1e5 * std::pow(value, -2.5); });
  EXPECT_FALSE(search.is_met());
  EXPECT_NE(search.reason().find("no more than "), std::string::npos) << search.reason();
  EXPECT_NE(search.reason().find(": too large"), std::string::npos) << search.reason();
  EXPECT_LT(search.best()->value, 1.5);
}

TEST(DialSearch, AJumpIsFoundAndSaid) {
  const DialSearch search =
      searched(kLength, 50000, [](double value) { return value < 1.7 ? 100000.0 : 10000.0; });
  EXPECT_FALSE(search.is_met());
  EXPECT_NE(search.reason().find("the number jumps from 10,000 elements"), std::string::npos)
      << search.reason();
}

TEST(DialSearch, NoMeshAtAllHasTheFailureAsItsReason) {
  const DialSearch search = searched(kLength, 1000, [](double) { return 0.0; });
  EXPECT_EQ(search.best(), nullptr);
  EXPECT_EQ(search.reason(), "too large");
}

TEST(DialSearch, MeetsBudgetsOfASawtooth) {
  // A lattice of half the spacing gives the same mesh as long as a bound on the error decides.
  const Mesher mesher = [](double value) {
    const double within = std::fmod(std::log2(value) + 20, 1.0);
    return value > 4 ? 2e6 * std::pow(value, -2.5) : 6e4 * std::pow(2, -1.5 * within);
  };
  EXPECT_TRUE(searched(kLength, 30000, mesher).is_met());
}

}  // namespace
}  // namespace cbc3d::reports

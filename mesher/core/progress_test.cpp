#include "mesher/core/progress.hpp"

#include <gtest/gtest.h>

#include <vector>


namespace cbc3d {
namespace {

TEST(Progress, WithoutObserverNothingHappens) {
  EXPECT_NO_THROW(Progress().step("a", 0));
  EXPECT_NO_THROW(Progress(ProgressObserver{}).step("a", 0));
}

TEST(Progress, TheObserverGetsStageAndFraction) {
  std::vector<std::pair<std::string, double>> seen;
  const Progress progress([&](std::string_view stage, double fraction) {
    seen.emplace_back(stage, fraction);
    return true;
  });
  progress.step("a", 0.25);
  progress.step("b", 1);
  EXPECT_EQ(seen, (std::vector<std::pair<std::string, double>>{{"a", 0.25}, {"b", 1}}));
}

TEST(Progress, FalseCancelsAndNamesTheStep) {
  const Progress progress([](std::string_view stage, double) { return stage != "b"; });
  EXPECT_NO_THROW(progress.step("a", 0));
  try {
    progress.step("b", 0.5);
    FAIL();
  } catch (const Cancelled& cancelled) {
    EXPECT_STREQ(cancelled.what(), "cancelled before the step 'b'");
  }
}

}  // namespace
}  // namespace cbc3d

#include "mesher/core/progress.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "mesher/core/terminal_progress.hpp"

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

std::string printed(bool quiet) {
  testing::internal::CaptureStderr();
  {
    TerminalProgress progress(quiet);
    const Progress& base = progress;
    base.step("meshing", 0.5);
    progress.line("said");
    progress.line("important", true);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(TerminalProgress, PrintsLinesWhereThereIsNoTerminal) {
  const std::string text = printed(false);
  EXPECT_NE(text.find(" 50 % meshing\n"), std::string::npos) << text;
  EXPECT_NE(text.find("said\nimportant\n"), std::string::npos) << text;
}

TEST(TerminalProgress, WhenQuietOnlyImportantLines) {
  EXPECT_EQ(printed(true), "important\n");
}

}  // namespace
}  // namespace cbc3d

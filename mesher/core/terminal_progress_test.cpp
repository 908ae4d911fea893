// Progress on a stream that is no terminal.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mesher/core/terminal_progress.hpp"

namespace cbc3d {
namespace {

template <typename Work>
std::string printed(bool quiet, const Work& work) {
  ::testing::internal::CaptureStderr();
  {
    TerminalProgress progress(quiet);
    work(progress);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(TerminalProgress, StepsArePlainLinesWithTheShareDone) {
  const std::string text = printed(false, [](TerminalProgress& p) {
    p.step("first", 0.5);
    p.step("second", 1.7);
    p.step("third", -1);
    p.done();
  });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_NE(text.find(" 50 % first"), std::string::npos) << text;
  EXPECT_NE(text.find("100 % second"), std::string::npos) << text;
  EXPECT_NE(text.find("  0 % third"), std::string::npos) << text;
}

TEST(TerminalProgress, QuietPrintsWhatIsImportantAlone) {
  EXPECT_EQ(printed(true,
                    [](TerminalProgress& p) {
                      p.step("first", 0.5);
                      p.line("a remark");
                      p.line("a warning", true);
                    }),
            "a warning\n");
  EXPECT_EQ(printed(false, [](TerminalProgress& p) { p.line("a remark"); }), "a remark\n");
}

}  // namespace
}  // namespace cbc3d

// The history as its users keep it.
#include <gtest/gtest.h>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

class HistoryCommand : public ::testing::Test {
 protected:
  /// Exit code of `cbc3d-bench history ...` on the store; what it prints is `text_`.
  int history(std::vector<std::string> arguments) {
    // The shell lets standard output take the place of standard error, whose end is kept.
    arguments.insert(arguments.begin(), {"/bin/sh", "-c", "exec \"$@\" 1>&2", "sh", BENCH, "history"});
    arguments.insert(arguments.end(), {"--store", folder_.path() / "store"});
    const ChildResult child = run_child({arguments, 1, 0, 0});
    text_ = child.stderr_tail;
    return child.exit_code;
  }
  int add(int commit, double cpu_s) {
    Json line = test::history_line(cpu_s);
    line["provenance"]["utc"] = test::commit_at(commit).date;
    folder_.write("results.jsonl", line.dump() + "\n");
    return history({"add", folder_.path(), "--commit", test::commit_at(commit).name});
  }
  bool printed(const std::string& words) const { return text_.find(words) != std::string::npos; }

  TemporaryFolder folder_;
  std::string text_;
};

TEST_F(HistoryCommand, AddsOnceAndShows) {
  ASSERT_EQ(add(1, 3), 0) << text_;
  EXPECT_TRUE(printed("commit c001 (by --commit) of 2026-01-02")) << text_;
  EXPECT_TRUE(printed("1 runs added, 0 were there already")) << text_;
  ASSERT_EQ(add(1, 3), 0);
  EXPECT_TRUE(printed("0 runs added, 1 were there already")) << text_;
  ASSERT_EQ(history({"show"}), 0);
  EXPECT_TRUE(printed("box, cbc3d, 1 thread on TestCPU, 2 cores") && printed("c001")) << text_;
}

TEST_F(HistoryCommand, APlantedRegressionEndsWithOneAndIsNamed) {
  const std::vector<double> times = test::noisy_times(4, 40, 25, 1.08);
  for (std::size_t n = 0; n < times.size(); ++n) {
    ASSERT_EQ(add(static_cast<int>(n), times[n]), 0) << text_;
  }
  EXPECT_EQ(history({"regressions", "--since", "c010"}), 1);
  EXPECT_TRUE(printed("c025 (2026-01-26)") || printed("c024 (2026-01-25)") || printed("c026 (2026-01-27)"))
      << text_;
  EXPECT_TRUE(printed("regressions: 1, new since commit c010: 1")) << text_;
  EXPECT_EQ(history({"regressions"}), 0) << "it was known before the last commit";
  EXPECT_TRUE(printed("regressions: 1, new since commit c038: 0")) << text_;
  ASSERT_EQ(history({"page", "--out", folder_.path() / "page.html"}), 0) << text_;
  EXPECT_NE(folder_.content("page.html").find("</html>"), std::string::npos);
  EXPECT_EQ(history({"regressions", "--since", "nonsense"}), 2);
  EXPECT_EQ(history({"regressions", "--metric", "nonsense"}), 2);
}

}  // namespace
}  // namespace cbc3d::reports

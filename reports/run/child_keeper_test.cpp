#include "reports/run/child_keeper.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/testing_processes.hpp"

namespace cbc3d::reports {
namespace {

/// A command under its keeper, and the end of both.
class Kept {
 public:
  explicit Kept(std::vector<std::string> argv, std::vector<std::string> variables = {})
      : child_(start_kept_child(std::move(argv), std::move(variables))) {}
  ~Kept() {
    cut_lifeline();
    ::waitpid(child_.keeper, nullptr, 0);
    ::close(child_.report);
    ::close(child_.errors);
  }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  void cut_lifeline() {
    if (child_.lifeline >= 0) {
      ::close(child_.lifeline);
      child_.lifeline = -1;
    }
  }
  [[nodiscard]] KeeperReport report() const {
    KeeperReport report;
    EXPECT_EQ(::read(child_.report, &report, sizeof report), static_cast<ssize_t>(sizeof report));
    return report;
  }
  /// Once the report is there, for reading does not block.
  [[nodiscard]] std::string errors() const {
    std::string text(4096, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(child_.errors, text.data(), 4096))));
    return text;
  }

 private:
  KeptChild child_;
};

TEST(ChildKeeper, ReportsHowTheCommandEnded) {
  const KeeperReport report = Kept({TEST_CHILD, "exit", "7"}).report();
  EXPECT_EQ(report.start_error, 0);
  ASSERT_TRUE(WIFEXITED(report.wait_status));
  EXPECT_EQ(WEXITSTATUS(report.wait_status), 7);
  EXPECT_GT(report.usage.ru_maxrss, 0);
}

TEST(ChildKeeper, ReportsWhyACommandCouldNotStart) {
  EXPECT_EQ(Kept({"/nowhere/program"}).report().start_error, ENOENT);
}

TEST(ChildKeeper, TheCommandHasTheVariablesGivenAndNoOthers) {
  ::setenv("CBC3D_OF_THE_TEST", "inherited", 1);
  const Kept given({TEST_CHILD, "env", "CBC3D_OF_THE_TEST"}, {"CBC3D_OF_THE_TEST=given"});
  static_cast<void>(given.report());
  EXPECT_EQ(given.errors(), "given\n");
  const Kept none({TEST_CHILD, "env", "CBC3D_OF_THE_TEST"});
  static_cast<void>(none.report());
  EXPECT_EQ(none.errors(), "unset\n");
  ::unsetenv("CBC3D_OF_THE_TEST");
}

TEST(ChildKeeper, CuttingTheLifelineEndsTheCommandAndWhatItStarted) {
  const cbc3d::testing::TemporaryFolder folder("keeper");
  Kept kept({TEST_CHILD, "spawn-and-stay", folder.file("process")});
  const pid_t grandchild = test::await_process(folder.file("process"));
  EXPECT_FALSE(test::is_gone(grandchild));
  kept.cut_lifeline();
  const KeeperReport report = kept.report();
  ASSERT_TRUE(WIFSIGNALED(report.wait_status));
  EXPECT_EQ(WTERMSIG(report.wait_status), SIGKILL);
  EXPECT_TRUE(test::is_gone(grandchild));
}

}  // namespace
}  // namespace cbc3d::reports

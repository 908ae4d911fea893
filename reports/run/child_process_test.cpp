#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/child_process.hpp"
#include "reports/run/testing_processes.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using test::kNoTimeLimit;

ChildResult run(std::vector<std::string> arguments, double timeout_s = kNoTimeLimit, std::int64_t memory = 0,
                int threads = 0) {
  arguments.insert(arguments.begin(), TEST_CHILD);
  return run_child({arguments, threads, timeout_s, memory});
}

TEST(ChildProcess, ReportsTheExitCode) {
  for (const int code : {0, 1, 42}) {
    const ChildResult result = run({"exit", std::to_string(code)});
    EXPECT_EQ(result.end, ChildEnd::exited);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_GT(result.peak_rss_bytes, 0);
  }
}

TEST(ChildProcess, ReportsTheSignalOfACrash) {
  const ChildResult result = run({"crash"});
  EXPECT_EQ(result.end, ChildEnd::signalled);
  EXPECT_EQ(result.signal, SIGSEGV);
  EXPECT_EQ(last_line(result.stderr_tail), "about to crash");
  EXPECT_EQ(signal_name(result.signal), "SIGSEGV (Segmentation fault)");
}

TEST(ChildProcess, KillsAtTheTimeLimit) {
  const ChildResult result = run({"sleep"}, 0.3);
  EXPECT_EQ(result.end, ChildEnd::timeout);
  EXPECT_GE(result.wall_s, 0.3);
  EXPECT_LT(result.wall_s, 120);  // the child's own end
}

TEST(ChildProcess, KillsAtTheMemoryLimit) {
  constexpr std::int64_t kLimit = std::int64_t{256} << 20;
  const ChildResult result = run({"allocate"}, kNoTimeLimit, kLimit);
  EXPECT_EQ(result.end, ChildEnd::out_of_memory);
  EXPECT_GT(result.peak_rss_bytes, kLimit);
}

TEST(ChildProcess, SaysThatAProgramCannotBeStarted) {
  const ChildResult result = run_child({{"/nowhere/mesher"}, 0, kNoTimeLimit, 0});
  EXPECT_EQ(result.end, ChildEnd::not_started);
  EXPECT_EQ(result.stderr_tail, "cannot run '/nowhere/mesher': No such file or directory");
}

TEST(ChildProcess, KeepsTheEndOfStandardError) {
  const ChildResult result = run({"flood"});
  EXPECT_EQ(last_line(result.stderr_tail), "line 19999 of the flood");
  EXPECT_LE(result.stderr_tail.size(), 16384U);
}

TEST(ChildProcess, SetsTheThreadCountOrLeavesIt) {
  EXPECT_EQ(last_line(run({"env", "OMP_NUM_THREADS"}, kNoTimeLimit, 0, 3).stderr_tail), "3");
  ::setenv("OMP_NUM_THREADS", "7", 1);
  EXPECT_EQ(last_line(run({"env", "OMP_NUM_THREADS"}).stderr_tail), "7");
  ::unsetenv("OMP_NUM_THREADS");
  ::setenv("OMP_PROC_BIND", "spread", 1);
  EXPECT_EQ(last_line(run({"env", "OMP_PROC_BIND"}).stderr_tail), "spread");
  EXPECT_EQ(
      last_line(run_child({{TEST_CHILD, "env", "OMP_PROC_BIND"}, 1, kNoTimeLimit, 0, true}).stderr_tail),
      "true");
  ::unsetenv("OMP_PROC_BIND");
}

TEST(ChildProcess, EndsWhatTheChildLeftBehind) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"spawn", folder.path() / "process"}).end, ChildEnd::exited);
  EXPECT_TRUE(test::is_gone(test::await_process(folder.path() / "process")));
}

/// A runner that gets `signal` while its child, with a grandchild, sleeps.
void expect_no_survivor_after(int signal) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "process";
  const pid_t runner = ::fork();
  ASSERT_GE(runner, 0);
  if (runner == 0) {
    run({"spawn-and-stay", file});
    std::_Exit(0);
  }
  const pid_t grandchild = test::await_process(file);
  ::kill(runner, signal);
  int status = 0;
  ::waitpid(runner, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), signal);
  test::await_end(grandchild);
}

TEST(ChildProcess, NothingSurvivesAnInterruptedRunner) {
  expect_no_survivor_after(SIGINT);
}

TEST(ChildProcess, NothingSurvivesATerminatedRunner) {
  expect_no_survivor_after(SIGTERM);
}

TEST(ChildProcess, NothingSurvivesARunnerKilledOutright) {
  expect_no_survivor_after(SIGKILL);
}

TEST(ChildProcess, AProcessThatLeftGroupAndSessionIsEndedToo) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"spawn-daemon", folder.path() / "process"}).end, ChildEnd::exited);
  EXPECT_TRUE(test::is_gone(test::await_process(folder.path() / "process")));
}

TEST(ChildProcess, MemoryOfAGrandchildCounts) {
  const ChildResult result = run({"spawn-allocate"}, kNoTimeLimit, std::int64_t{256} << 20);
  EXPECT_EQ(result.end, ChildEnd::out_of_memory);
}

TEST(ChildProcess, NoFileGrowsBeyondItsLimit) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "garbage";
  ChildResult result = run_child({{TEST_CHILD, "garbage", file}, 1, kNoTimeLimit, 0, false, 1000});
  EXPECT_EQ(result.end, ChildEnd::signalled);
  EXPECT_EQ(result.signal, SIGXFSZ);
  EXPECT_EQ(failure_text(result, 0, 0), "wrote a file beyond its limit; --file-limit sets that");
  EXPECT_LE(std::filesystem::file_size(file), 1000U);
  result = run_child({{TEST_CHILD, "garbage", file}, 1, kNoTimeLimit, 0, false, 5000});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(std::filesystem::file_size(file), 4096U);
}

TEST(ChildProcess, WhatIsPrintedHasNoControlCharacters) {
  EXPECT_EQ(printable("\x1B[31mred\a\r\x7F \xC2\x9B"
                      "8m\n\tend"),
            "[31mred 8m\n\tend");
  EXPECT_EQ(printable("caf\xC3\xA9 \xC2\xA0."), "caf\xC3\xA9 \xC2\xA0.");
  ChildResult result = run({"say", "\x1B]0;title\a bad"});
  result.exit_code = 1;
  EXPECT_EQ(failure_text(result, 0, 0), "]0;title bad");
}

TEST(ChildProcess, FindsTheLastLine) {
  EXPECT_EQ(last_line("one\ntwo\n\n  \n"), "two");
  EXPECT_EQ(last_line("bar 10 %\rbar 20 %"), "bar 20 %");
  EXPECT_EQ(last_line(" \n"), "");
}

}  // namespace
}  // namespace cbc3d::reports

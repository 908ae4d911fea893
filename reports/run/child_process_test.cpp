#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "reports/results/testing_folder.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

ChildResult run(std::vector<std::string> arguments, double timeout_s = 60, std::int64_t memory = 0,
                int threads = 0) {
  arguments.insert(arguments.begin(), TEST_CHILD);
  return run_child({arguments, threads, timeout_s, memory});
}

/// True once the process is gone (or a zombie that nobody waits for), within two seconds.
bool ends(pid_t process) {
  for (int n = 0; n < 200; ++n) {
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string id, name, state;
    if (!(stat >> id >> name >> state) || state == "Z") {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Waits for a process id in a file, up to five seconds.
pid_t read_process(const std::filesystem::path& file) {
  pid_t process = 0;
  for (int n = 0; n < 500 && process == 0; ++n) {
    std::ifstream(file) >> process;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return process;
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
  EXPECT_LT(result.wall_s, 10);
}

TEST(ChildProcess, KillsAtTheMemoryLimit) {
  constexpr std::int64_t kLimit = std::int64_t{256} << 20;
  const ChildResult result = run({"allocate"}, 60, kLimit);
  EXPECT_EQ(result.end, ChildEnd::out_of_memory);
  EXPECT_GT(result.peak_rss_bytes, kLimit);
}

TEST(ChildProcess, SaysThatAProgramCannotBeStarted) {
  const ChildResult result = run_child({{"/nowhere/mesher"}, 0, 10, 0});
  EXPECT_EQ(result.end, ChildEnd::not_started);
  EXPECT_EQ(result.stderr_tail, "cannot run '/nowhere/mesher': No such file or directory");
}

TEST(ChildProcess, KeepsTheEndOfStandardError) {
  const ChildResult result = run({"flood"});
  EXPECT_EQ(last_line(result.stderr_tail), "line 19999 of the flood");
  EXPECT_LE(result.stderr_tail.size(), 16384U);
}

TEST(ChildProcess, SetsTheThreadCountOrLeavesIt) {
  EXPECT_EQ(last_line(run({"env", "OMP_NUM_THREADS"}, 60, 0, 3).stderr_tail), "3");
  ::setenv("OMP_NUM_THREADS", "7", 1);
  EXPECT_EQ(last_line(run({"env", "OMP_NUM_THREADS"}).stderr_tail), "7");
  ::unsetenv("OMP_NUM_THREADS");
  ::setenv("OMP_PROC_BIND", "spread", 1);
  EXPECT_EQ(last_line(run({"env", "OMP_PROC_BIND"}).stderr_tail), "spread");
  EXPECT_EQ(last_line(run_child({{TEST_CHILD, "env", "OMP_PROC_BIND"}, 1, 60, 0, true}).stderr_tail), "true");
  ::unsetenv("OMP_PROC_BIND");
}

TEST(ChildProcess, EndsWhatTheChildLeftBehind) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"spawn", folder.path() / "process"}).end, ChildEnd::exited);
  EXPECT_TRUE(ends(read_process(folder.path() / "process")));
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
  const pid_t grandchild = read_process(file);
  ASSERT_GT(grandchild, 0);
  ::kill(runner, signal);
  int status = 0;
  ::waitpid(runner, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), signal);
  EXPECT_TRUE(ends(grandchild));
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
  EXPECT_TRUE(ends(read_process(folder.path() / "process")));
}

TEST(ChildProcess, MemoryOfAGrandchildCounts) {
  const ChildResult result = run({"spawn-allocate"}, 60, std::int64_t{256} << 20);
  EXPECT_EQ(result.end, ChildEnd::out_of_memory);
}

TEST(ChildProcess, FindsTheLastLine) {
  EXPECT_EQ(last_line("one\ntwo\n\n  \n"), "two");
  EXPECT_EQ(last_line("bar 10 %\rbar 20 %"), "bar 20 %");
  EXPECT_EQ(last_line(" \n"), "");
}

}  // namespace
}  // namespace cbc3d::reports

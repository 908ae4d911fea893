// The scripts as an engine runs them.
#include "reports/cluster/cluster_scripts.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <set>
#include <thread>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/results/result.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
namespace fs = std::filesystem;

constexpr int kJobs = 6;

TEST(ShellWord, IsOneWordWhateverIsInIt) {
  for (const std::string& text :
       {std::string("a b"), std::string("it's"), std::string("$(exit 3)`exit 4`\"\\\n*"), std::string()}) {
    const ChildResult child =
        run_child({{"/bin/sh", "-c", "[ \"$1\" = " + shell_word(text) + " ]", "sh", text}, 1, 0, 0});
    EXPECT_EQ(child.exit_code, 0) << text;
  }
}

/// A suite of two small phantoms and a mesher that waits as long as there is a file `hold`.
class Cluster : public ::testing::Test {
 protected:
  Cluster() {
    fs::create_directories(manifests_);
    for (const char* name : {"one", "two"}) {
      const Json manifest{
          {"name", name},
          {"title", "A small phantom"},
          {"suites", {"small"}},
          {"image",
           {{"phantom",
             {{"name", "shells"}, {"size", {16, 16, 16}}, {"spacing_mm", {1, 1, 1}}, {"seed", 1}}}}}};
      write_text_file(manifests_ / (std::string(name) + ".json"), manifest.dump());
    }
    const std::string script =
        "while [ -e \"$0\" ]; do touch \"$0.seen\"; sleep .05; done; exec \"$1\" mesh \"$2\" \"$3\"";
    const Json mesher{
        {"name", "tet"},
        {"description", "one tet"},
        {"licence", "Apache-2.0"},
        {"command", {"/bin/sh", "-c", script, hold_, TEST_CHILD, "{mesh}", "{report}", "{image}"}},
        {"output", "vtu"}};
    write_text_file(folder_.path() / "tet.json", mesher.dump());
  }
  int make_scripts(const fs::path& out) const {
    return run_child(
               {{BENCH, "cluster", "slurm", "--suite", "small", "--manifests", manifests_, "--external",
                 folder_.path() / "tet.json", "--mesher", "external:tet", "--repeat", "3", "--out", out},
                1,
                0,
                0})
        .exit_code;
  }
  ChildResult script(const char* name, const std::string& argument) const {
    return run_child({{"bash", out_ / name, argument}, 1, 0, 0});
  }
  void start_and_kill(const std::string& number) const {
    write_text_file(hold_, "");
    const pid_t job = ::fork();
    if (job == 0) {
      ::execlp("bash", "bash", (out_ / "job.sh").c_str(), number.c_str(), nullptr);
      ::_exit(127);
    }
    while (!fs::exists(hold_ + ".seen")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ::kill(job, SIGKILL);
    ::waitpid(job, nullptr, 0);
    fs::remove(hold_);
  }

  TemporaryFolder folder_;
  fs::path manifests_ = folder_.path() / "manifests";
  fs::path out_ = folder_.path() / "the out folder";
  std::string hold_ = folder_.path() / "hold";
};

TEST_F(Cluster, EveryJobIsThereOnceAlthoughOneWasKilled) {
  ASSERT_EQ(make_scripts(out_), 0);
  for (int n = 1; n <= kJobs; ++n) {
    const std::string number = std::to_string(n);
    if (n == 3) {
      start_and_kill(number);
      const ChildResult early = script("merge.sh", "");
      EXPECT_EQ(early.exit_code, 1);
      EXPECT_NE(early.stderr_tail.find("2 of 6 jobs are there; missing: 3 (one-external:tet-t1-r2) 4 "),
                std::string::npos)
          << early.stderr_tail;
      EXPECT_FALSE(fs::exists(out_ / "results.jsonl"));
    }
    for (int again = 0; again < 2; ++again) {
      const ChildResult job = script("job.sh", number);
      EXPECT_EQ(job.exit_code, 0) << job.stderr_tail;
    }
  }
  for (int again = 0; again < 2; ++again) {
    const ChildResult merged = script("merge.sh", "");
    EXPECT_EQ(merged.exit_code, 0) << merged.stderr_tail;
    std::set<std::string> ids;
    const std::vector<Json> lines = read_results(out_ / "results.jsonl");
    for (const Json& line : lines) {
      ids.insert(result_id(line));
      EXPECT_EQ(line["status"], "ok") << line["reason"];
    }
    EXPECT_EQ(lines.size(), 6U);
    EXPECT_EQ(ids.size(), 6U);
  }
}

TEST_F(Cluster, ScriptsOfOtherJobsAreRefused) {
  ASSERT_EQ(make_scripts(out_), 0);
  ASSERT_EQ(make_scripts(out_), 0) << "the same again";
  write_text_file(out_ / "jobs.tsv", "1\tanother\n");
  EXPECT_EQ(make_scripts(out_), 2);
  EXPECT_EQ(make_scripts(folder_.path() / "100%"), 2) << "Slurm takes % for a pattern";
}

TEST_F(Cluster, NoSuchJobIsBadInput) {
  ASSERT_EQ(make_scripts(out_), 0);
  EXPECT_EQ(script("job.sh", "7").exit_code, 2);
  EXPECT_EQ(script("job.sh", "").exit_code, 2);
}

}  // namespace
}  // namespace cbc3d::reports

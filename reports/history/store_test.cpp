#include "reports/history/store.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using metrics::metric_id;
using test::commit_at;
using test::history_line;

std::vector<JobResult> results(std::vector<Json> lines) {
  return decode_lines(std::move(lines));
}

TEST(Store, GivesBackWhatWasAdded) {
  const TemporaryFolder folder;
  Json line = history_line(3);
  line["parameters"] = {{"size", "2"}};
  line["budget"] = 25000;
  Json failed = history_line(4, 1);
  failed["status"] = "crashed";
  failed["reason"] = "SIGSEGV";
  const Added added = add_to_store(folder.path(), results({line, failed}), commit_at(3), "");
  EXPECT_EQ(added.added, 2U);
  const std::vector<HistoryRun> runs = read_store(folder.path());
  ASSERT_EQ(runs.size(), 2U);
  const HistoryRun& good = runs[0].is_ok() ? runs[0] : runs[1];
  const HistoryRun& bad = runs[0].is_ok() ? runs[1] : runs[0];
  EXPECT_EQ(good.commit.name, "c003");
  EXPECT_EQ(good.commit.date, "2026-01-04T00:00:00Z");
  EXPECT_EQ(good.machine, "TestCPU, 2 cores");
  EXPECT_EQ(good.mesher_version, "1.0");
  EXPECT_EQ(good.parameters, (Parameters{{"size", "2"}}));
  EXPECT_EQ(good.budget, 25000);
  EXPECT_EQ(good.figures[metric_id("counts.tets")], 1000);
  EXPECT_DOUBLE_EQ(good.figures[metric_id("time_ratio")].value(), 30) << "derived again";
  EXPECT_EQ(bad.reason, "SIGSEGV");
  EXPECT_FALSE(bad.figures[metric_id("counts.tets")].has_value());
}

TEST(Store, TheSameRunTwiceChangesNothing) {
  const TemporaryFolder folder;
  const std::vector<JobResult> run = results({history_line(3), history_line(3.1, 1)});
  add_to_store(folder.path(), run, commit_at(0), "");
  const std::string before = folder.content("c000.jsonl");
  const auto written = std::filesystem::last_write_time(folder.file("c000.jsonl"));
  const Added again = add_to_store(folder.path(), run, commit_at(0), "");
  EXPECT_EQ(again.added, 0U);
  EXPECT_EQ(again.known, 2U);
  EXPECT_EQ(folder.content("c000.jsonl"), before);
  EXPECT_EQ(std::filesystem::last_write_time(folder.file("c000.jsonl")), written);
}

TEST(Store, ItsBytesDoNotDependOnTheOrder) {
  const TemporaryFolder a("a"), b("b");
  const std::vector<JobResult> one = results({history_line(3)}), two = results({history_line(9, 1)});
  add_to_store(a.path(), one, commit_at(0), "");
  add_to_store(a.path(), two, commit_at(0), "");
  add_to_store(b.path(), two, commit_at(0), "");
  add_to_store(b.path(), one, commit_at(0), "");
  EXPECT_EQ(a.content("c000.jsonl"), b.content("c000.jsonl"));
}

TEST(Store, ANamedMachineIsThat) {
  const TemporaryFolder folder;
  add_to_store(folder.path(), results({history_line(3)}), commit_at(0), "runner <b>");
  EXPECT_EQ(read_store(folder.path()).front().machine, "runner <b>");
}

bool git(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(),
                   {"git", "-C", folder, "-c", "user.name=T", "-c", "user.email=t@example.org"});
  const ChildResult child = run_child({arguments, 0, 0, 0});
  return child.end == ChildEnd::exited && child.exit_code == 0;
}

/// Two branches of a store add runs of one commit and of a commit each; git joins them by itself.
TEST(Store, BranchesMergeWithoutConflict) {
  const TemporaryFolder folder;
  if (!git(folder.path(), {"init", "-q", "-b", "one"})) {
    GTEST_SKIP() << "git is not installed";
  }
  const auto add = [&](double cpu_s, int commit, const char* machine) {
    add_to_store(folder.path(), results({history_line(cpu_s)}), commit_at(commit), machine);
    return git(folder.path(), {"add", "-A"}) && git(folder.path(), {"commit", "-q", "-m", "figures"});
  };
  ASSERT_TRUE(add(1, 0, "a"));
  ASSERT_TRUE(git(folder.path(), {"branch", "two"}));
  ASSERT_TRUE(add(2, 1, "a") && add(2.5, 2, "a"));
  ASSERT_TRUE(git(folder.path(), {"checkout", "-q", "two"}));
  ASSERT_TRUE(add(3, 1, "b") && add(3.5, 3, "b"));
  ASSERT_TRUE(git(folder.path(), {"merge", "-q", "one", "-m", "both"}));
  EXPECT_EQ(read_store(folder.path()).size(), 5U);
}

TEST(Store, ALineThatIsThereTwiceCountsOnce) {
  const TemporaryFolder folder;
  add_to_store(folder.path(), results({history_line(3)}), commit_at(0), "");
  const std::string line = folder.content("c000.jsonl");
  folder.write("c000.jsonl", line + line);
  EXPECT_EQ(read_store(folder.path()).size(), 1U);
}

void expect_refused(const std::filesystem::path& folder, const std::string& words) {
  try {
    read_store(folder);
    FAIL() << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Store, DamageIsNamed) {
  const TemporaryFolder folder;
  expect_refused(folder.path(), "holds no *.jsonl with lines");
  expect_refused(folder.path() / "none", "holds no *.jsonl with lines");
  add_to_store(folder.path(), results({history_line(3)}), commit_at(0), "");
  const std::string good = folder.content("c000.jsonl");
  folder.write("c000.jsonl", good + "{\"case\":\"a\",\"mesher\":\"b\"}\n");
  expect_refused(folder.path(), "c000.jsonl': line 2: \"format\" is not");
  folder.write("c000.jsonl", "<<<<<<< HEAD\n");
  expect_refused(folder.path(), "c000.jsonl': line 1");
  std::string bad = good;
  bad.replace(bad.find("\"figures\":{"), 11, "\"figures\":[],\"x\":{");
  folder.write("c000.jsonl", bad);
  expect_refused(folder.path(), "\"figures\" is no object");
}

}  // namespace
}  // namespace cbc3d::reports

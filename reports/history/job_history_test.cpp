#include "reports/history/job_history.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;

HistoryRun run(const std::string& commit, const std::string& date, double cpu_s) {
  HistoryRun one;
  one.commit = {commit, date};
  one.machine = "M";
  one.case_name = "liver";
  one.mesher = "cgal";
  one.mesher_version = "5.5";
  one.status = "ok";
  one.utc = date;
  one.figures[metric_id("time_s.cpu")] = cpu_s;
  return one;
}

TEST(JobHistory, CommitsStandInTheOrderOfTheirDates) {
  const History history = make_history({run("aa", "2026-03-01", 1), run("bb", "2026-01-01", 2),
                                        run("cc", "2026-02-01", 3), run("aa", "2025-12-01", 4)});
  ASSERT_EQ(history.commits.size(), 3U);
  EXPECT_EQ(history.commits[0].name, "aa") << "by the earliest date that is known of it";
  EXPECT_EQ(history.commits[1].name, "bb");
  EXPECT_EQ(history.commits[2].name, "cc");
}

TEST(JobHistory, CommitsOfOneDateStandInTheOrderOfTheirRuns) {
  HistoryRun later = run("aa", "2026-01-01", 1), earlier = run("bb", "2026-01-01", 1);
  later.utc = "2026-01-03";
  earlier.utc = "2026-01-02";
  const History history = make_history({later, earlier});
  EXPECT_EQ(history.commits[0].name, "bb");
}

TEST(JobHistory, RepeatsAreOnePoint) {
  HistoryRun failed = run("aa", "2026-01-01", 0);
  failed.status = "crashed";
  failed.reason = "SIGSEGV";
  failed.figures = {};
  const History history = make_history({run("aa", "2026-01-01", 3), run("aa", "2026-01-01", 2), failed});
  ASSERT_EQ(history.jobs.size(), 1U);
  ASSERT_EQ(history.jobs[0].points.size(), 1U);
  const JobPoint& point = history.jobs[0].points[0];
  EXPECT_EQ(point.runs, 3);
  EXPECT_EQ(point.failure, "crashed: SIGSEGV");
  EXPECT_EQ(point.figures[metric_id("time_s.cpu")], 2) << "the least";
  EXPECT_EQ(point.versions, (std::set<std::string>{"5.5"}));
}

TEST(JobHistory, WhatMakesJobsDifferent) {
  std::vector<HistoryRun> runs(7, run("aa", "2026-01-01", 1));
  runs[1].machine = "N";
  runs[2].threads = 2;
  runs[3].parameters = {{"size", "2"}};
  runs[4].budget = 25000;
  runs[5].image_sha256 = "0123456789abcdef";
  runs[6].mesher_version = "6.0";  // no other job
  const History history = make_history(runs);
  EXPECT_EQ(history.jobs.size(), 6U);
  std::set<std::string> names;
  for (const JobHistory& job : history.jobs) {
    names.insert(job.machine + ": " + job.name);
  }
  EXPECT_EQ(names.size(), 6U);
  EXPECT_TRUE(names.contains("N: liver, cgal, 1 thread"));
  EXPECT_TRUE(names.contains("M: liver, cgal, 1 thread, size=2"));
  EXPECT_TRUE(names.contains("M: liver, cgal, 1 thread, image 01234567"));
  EXPECT_TRUE(names.contains("M: liver, 25000 elements, cgal, 1 thread"));
}

TEST(JobHistory, ACommitIsFoundByTheBeginningOfItsName) {
  const History history = make_history({run("abc1", "1", 1), run("abd2", "2", 1), run("ab", "3", 1)});
  EXPECT_EQ(commit_number(history, "abc", "--since"), 0U);
  EXPECT_EQ(commit_number(history, "ab", "--since"), 2U) << "the whole name goes first";
  EXPECT_THROW(commit_number(history, "a", "--since"), InputError);
  EXPECT_THROW(commit_number(history, "x", "--since"), InputError);
  EXPECT_THROW(commit_number(history, "", "--since"), InputError);
}

TEST(JobHistory, SelectsAndCuts) {
  HistoryRun other = run("bb", "2026-01-02", 1);
  other.case_name = "knee";
  const History history = make_history({run("aa", "2026-01-01", 1), run("bb", "2026-01-02", 1), other});
  EXPECT_EQ(select(history, {{"knee"}, {}, {}}).jobs.size(), 1U);
  EXPECT_EQ(select(history, {}).jobs.size(), 2U);
  EXPECT_THROW(select(history, {{"lung"}, {}, {}}), InputError);
  EXPECT_THROW(select(history, {{}, {"tetgen"}, {}}), InputError);
  EXPECT_THROW(select(history, {{}, {}, {"Mars"}}), InputError);
  const History first = up_to(history, 0);
  EXPECT_EQ(first.commits.size(), 1U);
  for (const JobHistory& job : first.jobs) {
    EXPECT_EQ(job.points.size(), job.case_name == "knee" ? 0U : 1U);
  }
}

TEST(JobHistory, HashesAreShownShort) {
  EXPECT_EQ(short_name({"0123456789abcdef0123456789abcdef01234567", ""}), "0123456789");
  EXPECT_EQ(short_name({"release-candidate-of-the-second-of-november", ""}),
            "release-candidate-of-the-second-of-november");
}

}  // namespace
}  // namespace cbc3d::reports

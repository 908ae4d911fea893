#include "reports/gate/time_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reports/gate/testing_gate.hpp"

namespace cbc3d::reports {
namespace {

/// A run of `count` repeats whose CPU times scatter by 2 % about `seconds`.
std::vector<Json> timed_run(int count, double seconds, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(1, 0.02);
  std::vector<Json> run;
  for (int repeat = 0; repeat < count; ++repeat) {
    run.push_back(good_line(repeat));
    run.back()["time_s"]["cpu"] = seconds * noise(random);
  }
  return run;
}

Json baseline_of(const std::vector<Json>& run) {
  return make_baseline(decode_lines(run), Json(), "why");
}

const CompareOptions kTested{.time_test = TimeTest{}};

std::string time_text(const Verdict& verdict) {
  for (const Check& check : verdict.checks) {
    if (check.figure == "time_ratio") return check.text;
  }
  return "";
}

TEST(TimeCheck, EightPerCentFallByTheTestAndNotByTheFixedTolerance) {
  const Json former = baseline_of(timed_run(10, 1, 1));
  const std::vector<Json> slower = timed_run(10, 1.08, 2);
  EXPECT_TRUE(compare_lines(slower, former).holds());
  const Verdict verdict = compare_lines(slower, former, kTested);
  EXPECT_EQ(verdict.fallen(), 1U) << to_text(verdict);
  EXPECT_NE(time_text(verdict).find("10 repeats against 10; falls from +5.0 % on with p at most 0.01)"),
            std::string::npos)
      << time_text(verdict);
}

TEST(TimeCheck, FasterIsBetterAndWhatIsBelowTheLeastChangeIsNeither) {
  const Json former = baseline_of(timed_run(10, 1, 1));
  const Verdict faster = compare_lines(timed_run(10, 0.9, 2), former, kTested);
  EXPECT_TRUE(faster.holds());
  EXPECT_NE(to_text(faster).find("better  box"), std::string::npos);
  EXPECT_TRUE(compare_lines(timed_run(10, 1.03, 2), former, kTested).holds());
  EXPECT_FALSE(compare_lines(timed_run(10, 1.03, 2), former,
                             {.time_test = TimeTest{.level = 0.05, .least_change_percent = 0}})
                   .holds());
}

TEST(TimeCheck, CpuTimeAloneLeavesOutADisturbedReference) {
  std::vector<Json> run = timed_run(10, 1.08, 2);
  for (Json& line : run)
    line["time_s"]["reference_cpu"] = 0.03;  // the reference work took half as long again
  const Json former = baseline_of(timed_run(10, 1, 1));
  EXPECT_TRUE(compare_lines(run, former, kTested).holds());
  const Verdict verdict = compare_lines(run, former, {.time_test = TimeTest{.figure = "time_s.cpu"}});
  EXPECT_EQ(verdict.fallen(), 1U);
  EXPECT_EQ(time_text(verdict).substr(0, 21), "CPU time: median was ") << time_text(verdict);
}

TEST(TimeCheck, UnchangedRunsRaiseNoAlarm) {
  int alarms = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Json former = baseline_of(timed_run(10, 1, 2 * seed));
    alarms += compare_lines(timed_run(10, 1, 2 * seed + 1), former, kTested).holds() ? 0 : 1;
  }
  EXPECT_EQ(alarms, 0);
}

TEST(TimeCheck, TooFewRepeatsAndOldBaselinesKeepTheFixedToleranceAndSaySo) {
  const Verdict few = compare_lines(timed_run(3, 2, 1), baseline_of(timed_run(3, 1, 2)), kTested);
  EXPECT_EQ(few.fallen(), 1U);
  EXPECT_NE(time_text(few).find("allowed"), std::string::npos);
  ASSERT_EQ(few.notes.size(), 1U);
  EXPECT_NE(few.notes[0].find("3 repeats against 3 cannot tell at p 0.01"), std::string::npos)
      << few.notes[0];
  Json old = baseline_of(timed_run(10, 1, 1));
  old["jobs"][0].erase("samples");
  const Verdict verdict = compare_lines(timed_run(10, 1.08, 2), old, kTested);
  EXPECT_TRUE(verdict.holds());
  ASSERT_EQ(verdict.notes.size(), 1U);
  EXPECT_NE(verdict.notes[0].find("the baseline has no samples of it; --update takes them in"),
            std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports

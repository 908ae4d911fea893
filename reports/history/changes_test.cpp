#include "reports/history/changes.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using metrics::metric_id;
using test::commit_at;
using test::history_line;
using test::Noise;
using test::noisy_times;

History history_of(const std::filesystem::path& folder) {
  return make_history(read_store(folder));
}

/// A store of 40 commits with 2 % noise in the times of two jobs and in their memory, those of the first
/// `factor` times as long from `first_changed` on.
History noisy_store(std::uint64_t seed, int first_changed, double factor) {
  const TemporaryFolder folder;
  Noise noise(seed);
  for (int n = 0; n < 40; ++n) {
    std::vector<Json> lines{history_line(10 * noise.factor(0.02) * (n >= first_changed ? factor : 1)),
                            history_line(3 * noise.factor(0.02), 0, "cgal")};
    for (Json& line : lines) {
      line["peak_rss_bytes"] = 5e7 * noise.factor(0.02);
    }
    add_to_store(folder.path(), decode_lines(lines), commit_at(n), "");
  }
  return history_of(folder.path());
}

TEST(Changes, APlantedOneOf8PercentIsFoundWithinOneCommit) {
  const History history = noisy_store(1, 25, 1.08);
  const std::vector<Change> changes = find_changes(history, {});
  ASSERT_EQ(changes.size(), 1U);
  const Change& change = changes[0];
  EXPECT_EQ(history.jobs[change.job].name, "box, cbc3d, 1 thread");
  EXPECT_EQ(change.metric, metric_id("time_ratio"));
  EXPECT_EQ(change.direction, Direction::worse);
  EXPECT_LE(std::abs(static_cast<int>(change.first_after) - 25), 1);
  EXPECT_EQ(change.last_before + 1, change.first_after);
  EXPECT_NEAR(change.after / change.before, 1.08, 0.015);
  EXPECT_EQ(change.count_before + change.count_after, 40U);
}

/// The level is the probability of an alarm in a store of four noisy series, so that of 20 stores one is
/// expected to give one. More than four would have a probability of .003 if the promise held.
TEST(Changes, TwentyUnchangedStoresGiveFewAlarms) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    alarms += find_changes(noisy_store(100 + seed, 1000, 1), {}).empty() ? 0 : 1;
  }
  RecordProperty("stores_with_alarm_of_20_at_level_0.05", alarms);
  EXPECT_LE(alarms, 4);
}

TEST(Changes, ABetterFigureIsNoRegression) {
  const History history = noisy_store(2, 20, 0.9);
  const std::vector<Change> changes = find_changes(history, {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].direction, Direction::better);
  EXPECT_TRUE(new_regressions(history, changes, std::nullopt, {}).empty());
}

TEST(Changes, AreNewOnceAndThenKnown) {
  const TemporaryFolder folder;
  const std::vector<double> times = noisy_times(4, 40, 30, 1.08);
  std::vector<std::size_t> alarms;
  for (std::size_t n = 0; n < times.size(); ++n) {
    add_to_store(folder.path(), decode_lines({history_line(times[n])}), commit_at(static_cast<int>(n)), "");
    const History history = history_of(folder.path());
    const auto before = n > 0 ? std::optional(n - 1) : std::nullopt;
    if (!new_regressions(history, find_changes(history, {}), before, {}).empty()) {
      alarms.push_back(n);
    }
  }
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_GE(alarms[0], 30U) << "not before there is anything";
  EXPECT_LE(alarms[0], 34U);
  const History history = history_of(folder.path());
  const std::vector<Change> changes = find_changes(history, {});
  EXPECT_TRUE(new_regressions(history, changes, 38, {}).empty());
  EXPECT_EQ(new_regressions(history, changes, 20, {}).size(), 1U);
  EXPECT_EQ(new_regressions(history, changes, std::nullopt, {}).size(), 1U);
}

TEST(Changes, NameTheRangeOfCommitsWithoutFigures) {
  const TemporaryFolder folder;
  const std::vector<double> times = noisy_times(4, 30, 15, 1.3);
  for (int n = 0; n < 30; ++n) {
    const bool ran = n < 13 || n > 16;
    add_to_store(folder.path(),
                 decode_lines({history_line(times[static_cast<std::size_t>(n)], 0, ran ? "cbc3d" : "cgal")}),
                 commit_at(n), "");
  }
  const std::vector<Change> changes = find_changes(history_of(folder.path()), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].last_before, 12U);
  EXPECT_EQ(changes[0].first_after, 17U);
}

TEST(Changes, AJobThatEndsNoMoreIsARegression) {
  const TemporaryFolder folder;
  for (int n = 0; n < 6; ++n) {
    Json line = history_line(3);
    if (n == 1 || n >= 4) {
      line["status"] = "crashed";
      line["reason"] = "SIGSEGV";
    }
    add_to_store(folder.path(), decode_lines({line}), commit_at(n), "");
  }
  const std::vector<Change> changes = find_changes(history_of(folder.path()), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_FALSE(changes[0].metric.has_value());
  EXPECT_EQ(changes[0].last_before, 3U);
  EXPECT_EQ(changes[0].first_after, 4U);
  EXPECT_EQ(changes[0].reason, "crashed: SIGSEGV");
  EXPECT_EQ(changes[0].direction, Direction::worse);
}

TEST(Changes, AnotherVersionOfTheMesherIsSaid) {
  const TemporaryFolder folder;
  const std::vector<double> times = noisy_times(4, 20, 10, 1.3);
  for (int n = 0; n < 20; ++n) {
    Json line = history_line(times[static_cast<std::size_t>(n)]);
    line["provenance"]["mesher_version"] = n < 10 ? "1.0" : "1.1";
    add_to_store(folder.path(), decode_lines({line}), commit_at(n), "");
  }
  const std::vector<Change> changes = find_changes(history_of(folder.path()), {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].reason, "version 1.0, then 1.1");
}

TEST(Changes, SmallOnesMayBeLeftOutAndOtherMetricsLookedAt) {
  const History history = noisy_store(1, 25, 1.08);
  ChangeOptions options;
  options.least_percent = 20;
  EXPECT_TRUE(find_changes(history, options).empty());
  options = {};
  options.metrics = {metric_id("time_s.cpu")};
  const std::vector<Change> changes = find_changes(history, options);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].metric, metric_id("time_s.cpu"));
}

TEST(Changes, DirectionsAreTheCatalogs) {
  EXPECT_EQ(direction_of(metric_id("time_ratio"), 1, 2), Direction::worse);
  EXPECT_EQ(direction_of(metric_id("quality.min_dihedral_deg"), 1, 2), Direction::better);
  EXPECT_EQ(direction_of(metric_id("counts.tets"), 2, 1), Direction::worse) << "any change is";
  EXPECT_EQ(direction_of(metric_id("elements"), 2, 1), Direction::neither);
  EXPECT_EQ(direction_of(metric_id("time_ratio"), 2, 2), Direction::neither);
}

TEST(Changes, MetricsAreFoundByTheirKeys) {
  EXPECT_EQ(metric_of_key("time_ratio", "--metric"), metric_id("time_ratio"));
  EXPECT_THROW(metric_of_key("speed", "--metric"), InputError);
}

}  // namespace
}  // namespace cbc3d::reports

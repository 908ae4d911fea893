// What changed in a history, and since when.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/job_history.hpp"

namespace cbc3d::reports {

enum class Direction { worse, better, neither };

/// A change of a figure of a job, or of whether the job ends well.
struct Change {
  std::size_t job = 0;                      ///< number in History::jobs
  std::optional<metrics::MetricId> metric;  ///< none: the job was ok and is not any more
  std::size_t last_before = 0;              ///< commit, the last with a figure as it was: the last good one
  std::size_t first_after = 0;              ///< commit, the first with a figure as it is now
  double before = 0, after = 0;  ///< medians from the former change to the next, as in result lines
  std::size_t count_before = 0, count_after = 0;  ///< commits that have them
  double p = 0;                                   ///< of the permutation test
  Direction direction = Direction::neither;
  std::string reason;  ///< why the job is not ok; or another version of the mesher
};

struct ChangeOptions {
  /// Probability that a store in which nothing changes is said to have a change: it is shared out equally
  /// among the series that are looked at (Bonferroni), leaving out those that are the same at every commit,
  /// in which nothing can be found.
  double level = 0.05;
  std::uint64_t seed = 1;
  double least_percent = 0;                ///< smaller changes are left out
  std::vector<metrics::MetricId> metrics;  ///< that are looked at; empty: default_metrics()
};

/// The metrics that the gate compares.
std::vector<metrics::MetricId> default_metrics();

/// The metric of a key. Throws InputError that begins with `option`.
metrics::MetricId metric_of_key(const std::string& key, const std::string& option);

/// The values of a metric of a job that are there, with the numbers of their points.
struct MetricSeries {
  std::vector<std::size_t> points;
  std::vector<double> values;
  [[nodiscard]] bool is_constant() const;
};
MetricSeries series_of(const JobHistory& job, metrics::MetricId id);

/// The direction of a change by the catalog.
Direction direction_of(metrics::MetricId id, double before, double after);

/// All changes, by job, metric and commit.
std::vector<Change> find_changes(const History& history, const ChangeOptions& options);

/// Those changes of `all` that are for the worse and were not to be seen yet in the figures up to the commit
/// `since` (none: no commit came before).
std::vector<Change> new_regressions(const History& history, const std::vector<Change>& all,
                                    std::optional<std::size_t> since, const ChangeOptions& options);

}  // namespace cbc3d::reports

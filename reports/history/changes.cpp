#include "reports/history/changes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mesher/core/error.hpp"
#include "reports/history/change_points.hpp"
#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::MetricId;

/// A series that is looked at.
struct Task {
  std::size_t job;
  MetricId id;
  MetricSeries series;
};

std::vector<Task> tasks_of(const History& history, const std::vector<MetricId>& ids) {
  std::vector<Task> tasks;
  for (std::size_t job = 0; job < history.jobs.size(); ++job) {
    for (const MetricId id : ids) {
      MetricSeries series = series_of(history.jobs[job], id);
      if (series.values.size() >= 2 * kFewestValues && !series.is_constant()) {
        tasks.push_back({job, id, std::move(series)});
      }
    }
  }
  return tasks;
}

/// A seed of the series' own, whichever others there are (FNV-1a).
std::uint64_t seed_of(std::uint64_t seed, const JobHistory& job, MetricId id) {
  std::uint64_t hash = 14695981039346656037U ^ seed;
  for (const std::string& text : {job.machine, job.name, std::string(metric(id).key)}) {
    for (const char c : text) {
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    }
  }
  return hash;
}

double median_between(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return median({values.begin() + static_cast<std::ptrdiff_t>(begin),
                 values.begin() + static_cast<std::ptrdiff_t>(end)});
}

/// "version 1.0, then 1.1", where the mesher is another.
std::string version_change(const JobPoint& before, const JobPoint& after) {
  const auto joined = [](const std::set<std::string>& versions) {
    std::string text;
    for (const std::string& version : versions) {
      text += (text.empty() ? "" : ", ") + version;
    }
    return text;
  };
  return before.versions == after.versions
             ? ""
             : "version " + joined(before.versions) + ", then " + joined(after.versions);
}

bool is_large(const Change& change, double least_percent) {
  return std::abs(change.after - change.before) >= least_percent / 100 * std::abs(change.before);
}

std::vector<Change> changes_of(const History& history, const Task& task, const ChangeOptions& options,
                               double level) {
  const JobHistory& job = history.jobs[task.job];
  const std::vector<double>& values = task.series.values;
  const std::vector<ChangePoint> points =
      find_change_points(values, {level, seed_of(options.seed, job, task.id)});
  std::vector<Change> changes;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::size_t at = points[n].first_changed;
    const std::size_t begin = n > 0 ? points[n - 1].first_changed : 0;
    const std::size_t end = n + 1 < points.size() ? points[n + 1].first_changed : values.size();
    const JobPoint &before = job.points[task.series.points[at - 1]],
                   &after = job.points[task.series.points[at]];
    Change change{.job = task.job,
                  .metric = task.id,
                  .last_before = before.commit,
                  .first_after = after.commit,
                  .before = median_between(values, begin, at),
                  .after = median_between(values, at, end),
                  .count_before = at - begin,
                  .count_after = end - at,
                  .p = points[n].p,
                  .direction = Direction::neither,
                  .reason = version_change(before, after)};
    change.direction = direction_of(task.id, change.before, change.after);
    if (is_large(change, options.least_percent)) {
      changes.push_back(std::move(change));
    }
  }
  return changes;
}

/// The job that was ok once and is not at its last commit.
std::optional<Change> failure_of(const JobHistory& job, std::size_t number) {
  const auto last_ok = std::find_if(job.points.rbegin(), job.points.rend(),
                                    [](const JobPoint& point) { return point.failure.empty(); });
  if (last_ok == job.points.rbegin() || last_ok == job.points.rend()) {
    return std::nullopt;
  }
  const JobPoint& first_bad = *(last_ok.base());
  Change change;
  change.job = number;
  change.last_before = last_ok->commit;
  change.first_after = first_bad.commit;
  change.count_before = static_cast<std::size_t>(job.points.rend() - last_ok);
  change.count_after = static_cast<std::size_t>(last_ok - job.points.rbegin());
  change.direction = Direction::worse;
  change.reason = first_bad.failure;
  return change;
}

bool is_same_series(const Change& a, const Change& b) {
  return a.job == b.job && a.metric == b.metric;
}

std::size_t distance(const Change& a, const Change& b) {
  return a.first_after > b.first_after ? a.first_after - b.first_after : b.first_after - a.first_after;
}

/// Numbers in `all` of the changes that `older`, found with fewer commits, are now: of each the nearest one
/// of its series, since a few figures more may move a change point.
std::set<std::size_t> known_ones(const std::vector<Change>& all, const std::vector<Change>& older) {
  std::set<std::size_t> known;
  for (const Change& old : older) {
    std::optional<std::size_t> nearest;
    for (std::size_t n = 0; n < all.size(); ++n) {
      const bool is_candidate = is_same_series(all[n], old) && all[n].direction == old.direction;
      if (is_candidate && (!nearest || distance(all[n], old) < distance(all[*nearest], old))) {
        nearest = n;
      }
    }
    if (nearest) {
      known.insert(*nearest);
    }
  }
  return known;
}

}  // namespace

std::vector<MetricId> default_metrics() {
  std::vector<MetricId> ids;
  for (const MetricId id : metrics::all_metrics()) {
    if (metric(id).gate != nullptr) {
      ids.push_back(id);
    }
  }
  return ids;
}

MetricId metric_of_key(const std::string& key, const std::string& option) {
  for (const MetricId id : metrics::all_metrics()) {
    if (metric(id).key == key) {
      return id;
    }
  }
  throw InputError(option + " '" + key + "' is unknown; `cbc3d-bench list metrics` has the keys");
}

bool MetricSeries::is_constant() const {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

MetricSeries series_of(const JobHistory& job, MetricId id) {
  MetricSeries series;
  for (std::size_t n = 0; n < job.points.size(); ++n) {
    const auto& value = job.points[n].figures[id];
    if (value && std::isfinite(*value)) {
      series.points.push_back(n);
      series.values.push_back(*value);
    }
  }
  return series;
}

Direction direction_of(MetricId id, double before, double after) {
  if (before == after) {
    return Direction::neither;
  }
  switch (metric(id).worse) {
    case metrics::Worse::higher:
      return after > before ? Direction::worse : Direction::better;
    case metrics::Worse::lower:
      return after < before ? Direction::worse : Direction::better;
    case metrics::Worse::other:
      return Direction::worse;
    case metrics::Worse::neither:
      break;
  }
  return Direction::neither;
}

std::vector<Change> find_changes(const History& history, const ChangeOptions& options) {
  const std::vector<Task> tasks =
      tasks_of(history, options.metrics.empty() ? default_metrics() : options.metrics);
  const double level = options.level / static_cast<double>(std::max<std::size_t>(tasks.size(), 1));
  std::vector<std::vector<Change>> of_task(tasks.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    of_task[n] = changes_of(history, tasks[n], options, level);
  }
  std::vector<Change> changes;
  for (std::size_t job = 0; job < history.jobs.size(); ++job) {
    if (auto failure = failure_of(history.jobs[job], job)) {
      changes.push_back(std::move(*failure));
    }
    for (std::size_t n = 0; n < tasks.size(); ++n) {
      if (tasks[n].job == job) {
        changes.insert(changes.end(), of_task[n].begin(), of_task[n].end());
      }
    }
  }
  return changes;
}

std::vector<Change> new_regressions(const History& history, const std::vector<Change>& all,
                                    std::optional<std::size_t> since, const ChangeOptions& options) {
  const std::set<std::size_t> known =
      since ? known_ones(all, find_changes(up_to(history, *since), options)) : std::set<std::size_t>();
  std::vector<Change> regressions;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const bool is_newer = !since || all[n].first_after > *since;
    if (all[n].direction == Direction::worse && (is_newer || !known.contains(n))) {
      regressions.push_back(all[n]);
    }
  }
  return regressions;
}

}  // namespace cbc3d::reports

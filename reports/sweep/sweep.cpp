#include "reports/sweep/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "reports/results/run_values.hpp"
#include "reports/statistics/bootstrap.hpp"
#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {
namespace {

Samples samples_of(const std::vector<double>& seconds) {
  Samples samples{seconds, outliers(seconds), 0, 0, 0};
  if (!seconds.empty()) {
    samples.median_s = median(seconds);
    samples.spread_s = spread(seconds);
    samples.error_s = median_error(seconds);
  }
  return samples;
}

double relative_error(const Samples& samples) {
  return samples.median_s > 0 ? samples.error_s / samples.median_s : 0;
}

SweepPoint point_of(const Runs& runs) {
  const JobResult& first = *runs.front();
  SweepPoint point{.case_name = first.case_name, .mesher = first.mesher, .threads = first.threads};
  point.total = samples_of(values_of(runs, shown_figure(metrics::metric_id("time_s.mesh"))));
  point.with_files = samples_of(values_of(runs, shown_figure(metrics::metric_id("time_s.process_wall"))));
  for (const JobResult* run : runs) {
    if (!run->is_ok()) {
      point.failure = run->status + ": " + run->reason;
    }
  }
  for (const auto& [stage, unused] : first.stage_seconds) {
    const std::string& name = stage;
    const std::vector<double> seconds =
        values_of(runs, [&](const JobResult& run) { return run.stage(name); });
    if (seconds.size() == point.total.seconds.size() && !seconds.empty()) {
      point.stages.emplace_back(name, samples_of(seconds));
    }
  }
  return point;
}

Ratio quotient(const Samples& base, const Samples& point) {
  const double value = base.median_s / point.median_s;
  return {value, value * std::hypot(relative_error(base), relative_error(point))};
}

/// Fills in the speed-up over the point of the same job with the fewest threads.
void compare(SweepPoint& point, const std::vector<SweepPoint>& points) {
  const SweepPoint* base = nullptr;
  for (const SweepPoint& other : points) {
    const bool same = other.case_name == point.case_name && other.mesher == point.mesher;
    if (same && !other.total.seconds.empty() && (base == nullptr || other.threads < base->threads)) {
      base = &other;
    }
  }
  if (base == nullptr || point.total.seconds.empty() || point.total.median_s <= 0) {
    return;
  }
  point.base_threads = base->threads;
  point.has_speed_up = base->threads != point.threads;
  if (point.has_speed_up) {
    point.speed_up = quotient(base->total, point.total);
    const double more = static_cast<double>(point.threads) / base->threads;
    point.efficiency = {point.speed_up.value / more, point.speed_up.error / more};
    for (const auto& [name, samples] : point.stages) {
      const auto same = std::find_if(base->stages.begin(), base->stages.end(),
                                     [&, wanted = name](const auto& stage) { return stage.first == wanted; });
      const bool comparable = same != base->stages.end() && samples.median_s > 0;
      point.stage_speed_ups.push_back(comparable ? quotient(same->second, samples) : Ratio{std::nan(""), 0});
    }
  }
}

Json to_json(const Samples& samples) {
  const auto interval = median_interval(samples.seconds);
  return {{"samples", samples.seconds},
          {"outlier", samples.outlier},
          {"median", samples.median_s},
          {"spread", samples.spread_s},
          {"standard_error", samples.error_s},
          {"median_interval", interval ? Json({interval->low, interval->high}) : Json()}};
}

}  // namespace

std::vector<SweepPoint> sweep_points(const std::vector<JobResult>& results) {
  std::vector<Runs> groups;
  for (const JobResult& result : results) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Runs& group) {
      const JobResult& first = *group.front();
      return first.case_name == result.case_name && first.mesher == result.mesher &&
             first.threads == result.threads;
    });
    (found == groups.end() ? *groups.insert(groups.end(), Runs{}) : *found).push_back(&result);
  }
  std::vector<SweepPoint> points;
  points.reserve(groups.size());
  for (const Runs& group : groups) {
    points.push_back(point_of(group));
  }
  const std::vector<SweepPoint> all = points;
  for (SweepPoint& point : points) {
    compare(point, all);
  }
  return points;
}

std::vector<SweepPoint> points_of_sweep(const std::filesystem::path& folder,
                                        const std::vector<JobResult>& results) {
  return std::filesystem::exists(folder / "sweep.json") && !folder.empty() ? sweep_points(results)
                                                                           : std::vector<SweepPoint>{};
}

Json to_json(const std::vector<SweepPoint>& points) {
  Json list = Json::array();
  for (const SweepPoint& point : points) {
    Json stages = Json::object();
    for (std::size_t n = 0; n < point.stages.size(); ++n) {
      Json& stage = stages[point.stages[n].first] = to_json(point.stages[n].second);
      const Ratio ratio = n < point.stage_speed_ups.size() ? point.stage_speed_ups[n] : Ratio{};
      stage["speed_up"] = point.has_speed_up ? Json(ratio.value) : Json();
      stage["speed_up_error"] = point.has_speed_up ? Json(ratio.error) : Json();
    }
    list.push_back({{"case", point.case_name},
                    {"mesher", point.mesher},
                    {"threads", point.threads},
                    {"seconds", to_json(point.total)},
                    {"seconds_with_files", to_json(point.with_files)},
                    {"base_threads", point.base_threads},
                    {"speed_up", point.has_speed_up ? Json(point.speed_up.value) : Json()},
                    {"speed_up_error", point.has_speed_up ? Json(point.speed_up.error) : Json()},
                    {"efficiency", point.has_speed_up ? Json(point.efficiency.value) : Json()},
                    {"efficiency_error", point.has_speed_up ? Json(point.efficiency.error) : Json()},
                    {"failure", point.failure},
                    {"stages", std::move(stages)}});
  }
  return list;
}

}  // namespace cbc3d::reports

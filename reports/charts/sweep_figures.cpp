#include "reports/charts/sweep_figures.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "reports/charts/chart.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<int> thread_counts(const std::vector<SweepPoint>& points) {
  std::set<int> counts;
  for (const SweepPoint& point : points) {
    counts.insert(point.threads);
  }
  return {counts.begin(), counts.end()};
}

Chart empty_chart(const std::vector<int>& threads, const std::string& title, const std::string& y_title) {
  Chart chart;
  chart.title = title;
  chart.x_title = "threads";
  chart.y_title = y_title;
  for (const int count : threads) {
    chart.categories.push_back(std::to_string(count));
  }
  return chart;
}

/// A series over the threads for every mesher of a case; `value` gives value and error of a point.
template <class Value>
void add_meshers(Chart& chart, const std::vector<int>& threads, const std::vector<SweepPoint>& points,
                 const std::string& case_name, Value value) {
  for (const SweepPoint& point : points) {
    if (point.case_name != case_name || point.total.seconds.empty()) {
      continue;
    }
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const Series& candidate) { return candidate.name == point.mesher; });
    if (series == chart.series.end()) {
      const std::vector<double> none(threads.size(), kNone);
      series = chart.series.insert(chart.series.end(),
                                   {point.mesher, none, std::vector<double>(threads.size(), 0), false});
    }
    const auto at =
        static_cast<std::size_t>(std::find(threads.begin(), threads.end(), point.threads) - threads.begin());
    std::tie(series->values[at], series->errors[at]) = value(point);
  }
}

void add_case_figures(std::vector<Figure>& figures, const std::vector<SweepPoint>& points,
                      const std::string& case_name) {
  const std::vector<int> threads = thread_counts(points);
  Chart times = empty_chart(threads, case_name + ": time over threads", "median time (s)");
  times.note = "Bars: spread of the samples (1.4826 x median absolute deviation)";
  times.logarithmic = true;
  add_meshers(times, threads, points, case_name,
              [](const SweepPoint& p) { return std::pair(p.total.median_s, p.total.spread_s); });
  figures.push_back({"sweep-time-" + case_name, times.title, line_chart(times)});
  Chart speed_up = empty_chart(threads, case_name + ": speed-up over threads", "speed-up");
  speed_up.note = "Bars: standard error. Dashed: as many times faster as threads";
  add_meshers(speed_up, threads, points, case_name,
              [](const SweepPoint& p) { return std::pair(p.speed_up.value, p.speed_up.error); });
  Series ideal{"ideal", {}, {}, true};
  for (const int count : threads) {
    ideal.values.push_back(static_cast<double>(count) / threads.front());
  }
  speed_up.series.push_back(ideal);
  figures.push_back({"sweep-speed-up-" + case_name, speed_up.title, line_chart(speed_up)});
}

void add_stage_figure(std::vector<Figure>& figures, const std::vector<SweepPoint>& points,
                      const std::string& case_name, const std::string& mesher) {
  Chart chart;
  chart.title = case_name + ", " + mesher + ": stages";
  chart.x_title = "stage";
  chart.y_title = "median time (s)";
  chart.note = "Bars: spread of the samples";
  for (const SweepPoint& point : points) {
    if (point.case_name != case_name || point.mesher != mesher || point.stages.empty()) {
      continue;
    }
    if (chart.categories.empty()) {
      for (const auto& stage : point.stages) {
        chart.categories.push_back(stage.first);
      }
    }
    Series series{
        std::to_string(point.threads) + (point.threads == 1 ? " thread" : " threads"), {}, {}, false};
    for (const std::string& name : chart.categories) {
      const auto stage = std::find_if(point.stages.begin(), point.stages.end(),
                                      [&](const auto& candidate) { return candidate.first == name; });
      series.values.push_back(stage == point.stages.end() ? kNone : stage->second.median_s);
      series.errors.push_back(stage == point.stages.end() ? 0 : stage->second.spread_s);
    }
    chart.series.push_back(std::move(series));
  }
  if (chart.categories.size() > 1) {
    figures.push_back({"sweep-stages-" + case_name + "-" + mesher, chart.title, bar_chart(chart)});
  }
}

}  // namespace

std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points) {
  std::vector<Figure> figures;
  std::set<std::string> cases;
  std::set<std::pair<std::string, std::string>> stages;
  for (const SweepPoint& point : points) {
    if (cases.insert(point.case_name).second) {
      add_case_figures(figures, points, point.case_name);
    }
    if (!point.stages.empty() && stages.insert({point.case_name, point.mesher}).second) {
      add_stage_figure(figures, points, point.case_name, point.mesher);
    }
  }
  return figures;
}

}  // namespace cbc3d::reports

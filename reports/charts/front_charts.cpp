#include "reports/charts/front_charts.hpp"

#include <algorithm>
#include <cmath>

#include "reports/charts/chart.hpp"
#include "reports/results/format_number.hpp"
#include "reports/results/front.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::MetricId;

/// What a front is drawn over.
struct FrontAxis {
  std::string name;   ///< in the names of files
  std::string words;  ///< in titles
  std::string title;  ///< of the axis
  FigureOf figure;
};

std::optional<double> unknowns_of(const JobResult& result) {
  const auto solved = result.figures[metric_id("solver.poisson_p1.unknowns")];
  return solved ? solved : result.figures[metric_id("quality.inner_vertices")];
}

std::vector<FrontAxis> front_axes() {
  return {{"elements", "elements", "elements", shown_figure(metric_id("elements"))},
          {"unknowns", "unknowns", "unknowns (vertices inside)", unknowns_of},
          {"seconds", "CPU time", "CPU time of meshing (s)", shown_figure(metric_id("time_s.cpu"))}};
}

/// A key as a part of a file's name.
std::string file_name(std::string_view key) {
  std::string name(key);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '_'; }, '-');
  return name;
}

/// True when a logarithmic axis has something to show: all values positive and of different sizes.
bool deserves_logarithm(const std::vector<PointSeries>& series) {
  constexpr double kLeastRatio = 3;
  double lowest = HUGE_VAL, highest = 0;
  for (const PointSeries& one : series) {
    for (const auto& point : one.points) {
      lowest = std::min(lowest, point.second);
      highest = std::max(highest, point.second);
    }
  }
  return lowest > 0 && highest > kLeastRatio * lowest;
}

Scatter front_of(const std::vector<JobResult>& results, const Columns& columns, const std::string& case_name,
                 MetricId id, const FrontAxis& axis) {
  const metrics::Metric& metric = metrics::metric(id);
  Scatter scatter;
  scatter.title = case_name + ": " + std::string(words(metric)) + " over " + axis.words;
  scatter.x_title = axis.title;
  scatter.y_title = title(metric);
  for (const std::string& column : columns.names()) {
    PointSeries series{column, {}};
    for (const FrontPoint& point :
         front_points(results, columns, case_name, column, axis.figure, compared_figure(id))) {
      series.points.emplace_back(point.x, point.y);
      series.jobs.push_back(case_name + ", " + column + ", asked for " +
                            format_number(static_cast<double>(point.budget), 0) + " elements");
    }
    if (!series.points.empty()) {
      scatter.series.push_back(std::move(series));
    }
  }
  scatter.logarithmic_x = true;
  scatter.logarithmic_y = deserves_logarithm(scatter.series);
  scatter.joined = true;
  scatter.note = metric.worse == metrics::Worse::lower ? "Higher is better." : "Lower is better.";
  return scatter;
}

}  // namespace

std::vector<Figure> front_charts(const std::vector<JobResult>& results) {
  const Columns columns(results);
  std::vector<Figure> figures;
  for (const std::string& case_name : image_names(results)) {
    for (const MetricId id : front_figures()) {
      for (const FrontAxis& axis : front_axes()) {
        const bool is_time_over_time = id == metric_id("time_s.cpu") && axis.name == "seconds";
        const Scatter scatter = front_of(results, columns, case_name, id, axis);
        if (!is_time_over_time && !scatter.series.empty()) {
          figures.push_back(
              {"front-" + case_name + "-" + file_name(metrics::metric(id).key) + "-" + axis.name,
               scatter.title, scatter_chart(scatter)});
        }
      }
    }
  }
  return figures;
}

}  // namespace cbc3d::reports

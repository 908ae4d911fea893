#include "reports/charts/figures.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesher/core/atomic_file.hpp"
#include "reports/charts/chart.hpp"
#include "reports/charts/front_charts.hpp"
#include "reports/results/columns.hpp"
#include "reports/results/format_number.hpp"
#include "reports/results/run_values.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kHistogramBins = 36;

using metrics::metric_id;
using metrics::MetricId;

/// "cgal (9.2-165.9 deg, 518,509 elements)": as in the paper, the extremes and the count stand by the name.
std::string histogram_name(const std::string& column, const JobResult& result) {
  const auto& lowest = result.figures[metric_id("quality.min_dihedral_deg")];
  const auto& highest = result.figures[metric_id("quality.max_dihedral_deg")];
  if (!lowest || !highest) {
    return column;
  }
  return column + " (" + format_number(*lowest, 1) + "-" + format_number(*highest, 1) + " deg, " +
         format_number(result.figures[metric_id("elements")].value_or(0), 0) + " elements)";
}

/// Shares in percent of the angles in each step.
std::vector<double> shares(std::vector<double> histogram) {
  const double sum = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  for (double& value : histogram) {
    value = sum > 0 ? 100 * value / sum : 0;
  }
  return histogram;
}

Chart histogram_of(const std::string& case_name, const Columns& columns) {
  Chart chart;
  chart.title = case_name + ": distribution of the dihedral angles";
  chart.x_title = "dihedral angle (deg): lower end of each step of 5";
  chart.y_title = "share of the angles (%)";
  chart.label_every = 3;
  for (std::size_t bin = 0; bin < kHistogramBins; ++bin) {
    chart.categories.push_back(std::to_string(5 * bin));
  }
  for (const std::string& column : columns.names()) {
    const JobResult* result = first_good(columns.runs(case_name, column));
    if (result != nullptr && result->dihedral_histogram.size() == kHistogramBins) {
      chart.series.push_back(
          {histogram_name(column, *result), shares(result->dihedral_histogram), {}, false});
    }
  }
  return chart;
}

/// Median of a metric over the good runs, in the unit in which it is shown; NaN without any.
double median_or_none(const Runs& runs, MetricId id) {
  return median_of(runs, shown_figure(id)).value_or(kNone);
}

/// A metric of every case and column: the median of its runs.
Chart comparison(const std::vector<JobResult>& results, const Columns& columns, MetricId id) {
  const metrics::Metric& metric = metrics::metric(id);
  Chart chart;
  chart.title = metrics::words(metric);
  chart.title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(chart.title.front())));
  chart.y_title = title(metric);
  chart.logarithmic = metric.logarithmic;
  chart.categories = case_names(results);
  for (const std::string& column : columns.names()) {
    Series series{column, {}, {}, false};
    for (const std::string& case_name : chart.categories) {
      series.values.push_back(median_or_none(columns.runs(case_name, column), id));
    }
    const bool any =
        std::any_of(series.values.begin(), series.values.end(), [](double v) { return std::isfinite(v); });
    if (any) {
      chart.series.push_back(std::move(series));
    }
  }
  return chart;
}

/// A column's name and, as a distance says nothing of them, how many labels its mesh lacks.
std::string name_with_missing(const std::string& column, const Runs& runs) {
  const JobResult* run = first_good(runs);
  const double missing = run == nullptr ? 0 : run->figures[metric_id("summary.missing_labels")].value_or(0);
  return missing > 0 ? column + " (" + format_number(missing, 0) +
                           (missing == 1 ? " label missing)" : " labels missing)")
                     : column;
}

/// Whose a point is: "liver, cgal", and of how many runs it is the median.
std::string job_of(const std::string& case_name, const std::string& column, const Runs& runs) {
  return case_name + ", " + name_with_missing(column, runs) +
         (runs.size() > 1 ? ", median of " + std::to_string(runs.size()) + " runs" : "");
}

/// An axis of a plane: a metric, times a factor.
struct Axis {
  MetricId id;
  double factor = 1;
};

std::string axis_title(MetricId id) {
  const metrics::Metric& metric = metrics::metric(id);
  return std::string(words(metric)) + (metric.unit.empty() ? "" : " (" + std::string(metric.unit) + ")");
}

/// Every mesher of a case in the plane of distance and another figure.
Scatter trade_off(const std::string& case_name, const Columns& columns, const Axis& y_axis,
                  bool logarithmic_y) {
  constexpr MetricId kDistance = metric_id("summary.hausdorff_diagonals");
  Scatter scatter;
  scatter.x_title = axis_title(kDistance);
  scatter.y_title = axis_title(y_axis.id);
  scatter.logarithmic_x = true;
  scatter.logarithmic_y = logarithmic_y;
  for (const std::string& column : columns.names()) {
    const Runs runs = columns.runs(case_name, column);
    const double x = median_or_none(runs, kDistance);
    const double y = y_axis.factor * median_or_none(runs, y_axis.id);
    if (x > 0 && (y > 0 || (!logarithmic_y && y == 0))) {
      scatter.series.push_back(
          {name_with_missing(column, runs), {{x, y}}, {job_of(case_name, column, runs)}});
    }
  }
  return scatter;
}

/// The two planes of a case; none where no mesh has a distance.
void add_trade_offs(const std::string& case_name, const Columns& columns, std::vector<Figure>& figures) {
  constexpr double kThousands = 1e-3;
  Scatter angle = trade_off(case_name, columns, {metric_id("summary.min_dihedral_deg")}, false);
  angle.title = case_name + ": distance and smallest dihedral angle";
  angle.note = "Better is up and left.";
  Scatter count = trade_off(case_name, columns, {metric_id("summary.elements"), kThousands}, true);
  count.title = case_name + ": distance and number of elements";
  count.y_title += " (thousands)";
  count.note = "Better is down and left.";
  for (const auto& [name, scatter] : {std::pair("angle", &angle), std::pair("elements", &count)}) {
    if (!scatter->series.empty()) {
      figures.push_back(
          {"distance-" + std::string(name) + "-" + case_name, scatter->title, scatter_chart(*scatter)});
    }
  }
}

}  // namespace

std::vector<Figure> result_figures(const std::vector<JobResult>& results) {
  std::vector<Figure> figures = front_charts(results);
  if (!figures.empty()) {
    return figures;  // bars for every budget would say less
  }
  const Columns columns(results);
  for (const MetricId id : metrics::all_metrics()) {
    if (const std::string name(metrics::metric(id).chart); !name.empty()) {
      const Chart chart = comparison(results, columns, id);
      if (!chart.series.empty()) {
        figures.push_back({name, chart.title, bar_chart(chart)});
      }
    }
  }
  for (const std::string& case_name : case_names(results)) {
    add_trade_offs(case_name, columns, figures);
  }
  for (const std::string& case_name : case_names(results)) {
    const Chart chart = histogram_of(case_name, columns);
    if (!chart.series.empty()) {
      figures.push_back({"histogram-" + case_name, chart.title, bar_chart(chart)});
    }
  }
  return figures;
}

void write_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                   TerminalProgress& progress) {
  constexpr double kTimeoutS = 60;
  std::filesystem::create_directories(folder);
  bool convert = true;
  for (const Figure& one : figures) {
    const std::filesystem::path svg = folder / (one.name + ".svg");
    write_text_file(svg, one.svg);
    if (!convert) {
      continue;
    }
    const ChildResult child = run_child(
        {{"rsvg-convert", "--zoom", "2", "--output", folder / (one.name + ".png"), svg}, 1, kTimeoutS, 0});
    if (child.end != ChildEnd::exited || child.exit_code != 0) {
      convert = child.end != ChildEnd::not_started;
      progress.line("no PNG of the plots: " + printable(last_line(child.stderr_tail)) +
                    (convert ? "" : "; install librsvg2-bin; the SVG files are there"));
    }
  }
}

}  // namespace cbc3d::reports

#include "reports/charts/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/core/atomic_file.hpp"
#include "reports/charts/chart.hpp"
#include "reports/results/columns.hpp"
#include "reports/results/statistics.hpp"
#include "reports/run/child_process.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kHistogramBins = 36;

bool is_ok(const Json& result) {
  return result.value("status", "") == "ok";
}

const Json* first_good(const std::vector<const Json*>& runs) {
  const auto found = std::find_if(runs.begin(), runs.end(), [](const Json* run) { return is_ok(*run); });
  return found == runs.end() ? nullptr : *found;
}

/// "cgal (9.2-165.9 deg, 518,509 elements)": as in the paper, the extremes and the count stand by the name.
std::string histogram_name(const std::string& column, const Json& result) {
  const Json lowest = figure(result, {"quality", "min_dihedral_deg"});
  const Json highest = figure(result, {"quality", "max_dihedral_deg"});
  double elements = 0;
  for (const char* kind : {"tets", "pyramids", "wedges", "hexes"}) {
    const Json count = figure(result, {"counts", kind});
    elements += count.is_number() ? count.get<double>() : 0;
  }
  if (!lowest.is_number() || !highest.is_number()) {
    return column;
  }
  return column + " (" + format_number(lowest.get<double>(), 1) + "-" +
         format_number(highest.get<double>(), 1) + " deg, " + format_number(elements, 0) + " elements)";
}

/// Shares in percent of the angles in each step.
std::vector<double> shares(const Json& histogram) {
  std::vector<double> values;
  double sum = 0;
  for (const Json& count : histogram) {
    values.push_back(count.is_number() ? count.get<double>() : 0);
    sum += values.back();
  }
  for (double& value : values) {
    value = sum > 0 ? 100 * value / sum : 0;
  }
  return values;
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
    const Json* result = first_good(columns.runs(case_name, column));
    const Json histogram =
        result == nullptr ? Json() : figure(*result, {"quality", "dihedral_histogram_5deg"});
    if (histogram.is_array() && histogram.size() == kHistogramBins) {
      chart.series.push_back({histogram_name(column, *result), shares(histogram), {}, false});
    }
  }
  return chart;
}

/// Median of a figure over the good runs; NaN without any.
double median_of(const std::vector<const Json*>& runs, const std::vector<std::string>& path) {
  std::vector<double> values;
  for (const Json* run : runs) {
    const Json value = figure(*run, path);
    if (is_ok(*run) && value.is_number()) {
      values.push_back(value.get<double>());
    }
  }
  return values.empty() ? kNone : median(values);
}

/// A value of every case and column: the median of its runs.
Chart comparison(const std::vector<Json>& results, const Columns& columns,
                 const std::vector<std::string>& path) {
  Chart chart;
  chart.categories = case_names(results);
  for (const std::string& column : columns.names()) {
    Series series{column, {}, {}, false};
    for (const std::string& case_name : chart.categories) {
      series.values.push_back(median_of(columns.runs(case_name, column), path));
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
std::string name_with_missing(const std::string& column, const std::vector<const Json*>& runs) {
  const Json* run = first_good(runs);
  const Json missing = run == nullptr ? Json() : figure(*run, {"summary", "missing_labels"});
  return missing.is_array() && !missing.empty()
             ? column + " (" + std::to_string(missing.size()) +
                   (missing.size() == 1 ? " label missing)" : " labels missing)")
             : column;
}

/// Every mesher of a case in the plane of distance and another figure of summary, times `unit`.
Scatter trade_off(const std::string& case_name, const Columns& columns, const std::string& key, double unit,
                  bool logarithmic_y) {
  constexpr double kLimitDiagonals = 1.1;
  Scatter scatter;
  scatter.x_title = "Hausdorff distance (the paper's), worst label (voxel diagonals)";
  scatter.logarithmic_x = true;
  scatter.logarithmic_y = logarithmic_y;
  scatter.x_limit = kLimitDiagonals;
  for (const std::string& column : columns.names()) {
    const std::vector<const Json*> runs = columns.runs(case_name, column);
    const double x = median_of(runs, {"summary", "hausdorff_diagonals"});
    const double y = unit * median_of(runs, {"summary", key});
    if (x > 0 && (y > 0 || (!logarithmic_y && y == 0))) {
      scatter.series.push_back({name_with_missing(column, runs), {{x, y}}});
    }
  }
  return scatter;
}

/// The two planes of a case; none where no mesh has a distance.
void add_trade_offs(const std::string& case_name, const Columns& columns, std::vector<Figure>& figures) {
  constexpr double kLimitDeg = 20, kThousands = 1e-3;
  Scatter angle = trade_off(case_name, columns, "min_dihedral_deg", 1, false);
  angle.title = case_name + ": distance and smallest dihedral angle";
  angle.y_title = "min dihedral angle (deg)";
  angle.y_limit = kLimitDeg;
  angle.note = "Better is up and left; dashed: 1.1 voxel diagonals, 20 degrees.";
  Scatter count = trade_off(case_name, columns, "elements", kThousands, true);
  count.title = case_name + ": distance and number of elements";
  count.y_title = "elements (thousands)";
  count.note = "Better is down and left; dashed: 1.1 voxel diagonals.";
  for (const auto& [name, scatter] : {std::pair("angle", &angle), std::pair("elements", &count)}) {
    if (!scatter->series.empty()) {
      figures.push_back(
          {"distance-" + std::string(name) + "-" + case_name, scatter->title, scatter_chart(*scatter)});
    }
  }
}

struct ComparisonPlan {
  const char* name;
  const char* title;
  const char* unit;
  std::vector<std::string> path;
  bool logarithmic;
};

}  // namespace

std::vector<Figure> result_figures(const std::vector<Json>& results) {
  static const std::vector<ComparisonPlan> plans{
      {"hausdorff",
       "Hausdorff distance (the paper's: surface vertices and boundary voxels)",
       "HD (mm)",
       {"fidelity", "hausdorff_mm"},
       false},
      {"surface-distance",
       "Surface Hausdorff distance",
       "distance (mm)",
       {"fidelity", "surface_hausdorff_mm"},
       false},
      {"time",
       "Meshing time, end to end without reading and writing files",
       "time (s)",
       {"time_s", "mesh"},
       true}};
  const Columns columns(results);
  std::vector<Figure> figures;
  for (const ComparisonPlan& plan : plans) {
    Chart chart = comparison(results, columns, plan.path);
    chart.title = plan.title;
    chart.y_title = plan.unit;
    chart.logarithmic = plan.logarithmic;
    if (!chart.series.empty()) {
      figures.push_back({plan.name, chart.title, bar_chart(chart)});
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
      progress.line("no PNG of the plots: " + last_line(child.stderr_tail) +
                    (convert ? "" : "; install librsvg2-bin; the SVG files are there"));
    }
  }
}

}  // namespace cbc3d::reports

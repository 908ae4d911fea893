#include "reports/results/front.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "reports/results/run_values.hpp"
#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::MetricId;
using metrics::Worse;

/// How far beyond its ends a curve still holds: the tolerance of the budgets.
constexpr double kReach = 1.1;

/// Runs of a case and a column with this budget.
Runs runs_with_budget(const std::vector<JobResult>& results, const Columns& columns,
                      const std::string& case_name, const std::string& column, std::int64_t budget) {
  Runs runs;
  for (const JobResult& result : results) {
    if (result.case_name == case_name && result.budget == budget && columns.name_of(result) == column) {
      runs.push_back(&result);
    }
  }
  return runs;
}

double interpolated(const std::pair<double, double>& a, const std::pair<double, double>& b, double x) {
  const double share = std::log(x / a.first) / std::log(b.first / a.first);
  return a.second > 0 && b.second > 0 ? a.second * std::pow(b.second / a.second, share)
                                      : a.second + share * (b.second - a.second);
}

/// None: no column has the figure.
std::optional<FrontComparison> compared(const std::string& case_name, std::int64_t budget, MetricId id,
                                        const std::vector<FrontCurve>& curves) {
  FrontComparison row{.case_name = case_name, .budget = budget, .id = id, .values = {}};
  const Worse worse = metrics::metric(id).worse;
  bool has_best = false;
  for (const FrontCurve& curve : curves) {
    const auto value = curve.at(static_cast<double>(budget));
    row.values.push_back(value);
    if (value && (!has_best || times_worse(row.best_value, *value, worse) > 1)) {
      row.best = row.values.size() - 1;
      row.best_value = *value;
      has_best = true;
    }
  }
  double lead = std::numeric_limits<double>::infinity();
  for (std::size_t column = 0; column < row.values.size(); ++column) {
    if (const auto& value = row.values[column]; value && column != row.best) {
      lead = std::min(lead, times_worse(*value, row.best_value, worse));
      row.has_rival = true;
    }
  }
  row.lead = row.has_rival ? lead : 1;
  return has_best ? std::optional(row) : std::nullopt;
}

}  // namespace

std::span<const MetricId> front_figures() {
  static constexpr std::array kFigures{
      metric_id("fidelity.mean_distance_mm"),     metric_id("fidelity.hd95_mm"),
      metric_id("fidelity.hausdorff_mm"),         metric_id("quality.mean_ratio.p1"),
      metric_id("quality.mean_ratio.median"),     metric_id("surface.facet_angle_rms_deg"),
      metric_id("solver.poisson_p1.h1_relative"), metric_id("topology.differences"),
      metric_id("volume_error_percent"),          metric_id("time_s.cpu")};
  return kFigures;
}

FigureOf compared_figure(MetricId id) {
  if (metrics::metric(id).worse == Worse::lower) {
    return shown_figure(id);
  }
  return [shown = shown_figure(id)](const JobResult& result) {
    const auto value = shown(result);
    return value ? std::optional(std::abs(*value)) : std::nullopt;
  };
}

FrontCurve::FrontCurve(Points points) {
  std::sort(points.begin(), points.end());
  for (std::size_t n = 0; n < points.size();) {
    double sum = 0;
    std::size_t end = n;
    for (; end < points.size() && points[end].first == points[n].first; ++end) {
      sum += points[end].second;
    }
    points_.emplace_back(points[n].first, sum / static_cast<double>(end - n));
    n = end;
  }
}

std::optional<double> FrontCurve::at(double elements) const {
  if (points_.empty() || elements < points_.front().first / kReach ||
      elements > points_.back().first * kReach) {
    return std::nullopt;
  }
  const auto above = std::lower_bound(points_.begin(), points_.end(), elements,
                                      [](const auto& point, double x) { return point.first < x; });
  if (above == points_.begin()) {
    return points_.front().second;
  }
  return above == points_.end() ? points_.back().second : interpolated(above[-1], above[0], elements);
}

std::vector<FrontPoint> front_points(const std::vector<JobResult>& results, const Columns& columns,
                                     const std::string& case_name, const std::string& column,
                                     const FigureOf& x, const FigureOf& y) {
  std::vector<FrontPoint> points;
  for (const std::int64_t budget : budgets_of(results, case_name)) {
    const Runs runs = runs_with_budget(results, columns, case_name, column, budget);
    const auto at = median_of(runs, x), value = median_of(runs, y);
    if (at && value && *at > 0) {
      points.push_back({budget, *at, *value});
    }
  }
  return points;
}

FrontCurve front_curve(const std::vector<JobResult>& results, const Columns& columns,
                       const std::string& case_name, const std::string& column, MetricId id) {
  FrontCurve::Points points;
  for (const FrontPoint& point : front_points(results, columns, case_name, column,
                                              shown_figure(metric_id("elements")), compared_figure(id))) {
    points.emplace_back(point.x, point.y);
  }
  return FrontCurve(std::move(points));
}

double times_worse(double value, double other, Worse worse) {
  const auto [more, less] = worse == Worse::lower ? std::pair(other, value) : std::pair(value, other);
  if (more == less) {
    return 1;
  }
  if (less <= 0) {
    return more > less ? std::numeric_limits<double>::infinity() : 0;
  }
  return std::max(0.0, more / less);
}

std::vector<FrontComparison> front_comparisons(const std::vector<JobResult>& results,
                                               const Columns& columns) {
  std::vector<FrontComparison> rows;
  for (const std::string& case_name : image_names(results)) {
    std::vector<FrontComparison> of_case;
    for (const MetricId id : front_figures()) {
      std::vector<FrontCurve> curves;
      for (const std::string& column : columns.names()) {
        curves.push_back(front_curve(results, columns, case_name, column, id));
      }
      for (const std::int64_t budget : budgets_of(results, case_name)) {
        if (auto row = compared(case_name, budget, id, curves)) {
          of_case.push_back(std::move(*row));
        }
      }
    }
    std::stable_sort(of_case.begin(), of_case.end(),
                     [](const FrontComparison& a, const FrontComparison& b) { return a.budget < b.budget; });
    rows.insert(rows.end(), of_case.begin(), of_case.end());
  }
  return rows;
}

std::string shortfall_of(const Runs& runs) {
  for (const JobResult* run : runs) {
    if (!run->is_ok()) {
      return failure_of(*run);
    }
    if (!run->budget_shortfall.empty()) {
      return run->budget_shortfall;
    }
  }
  return runs.empty() ? "not run" : "";
}

std::vector<std::int64_t> budgets_of(const std::vector<JobResult>& results, const std::string& case_name) {
  std::set<std::int64_t> budgets;
  for (const JobResult& result : results) {
    if (result.case_name == case_name && result.budget) {
      budgets.insert(*result.budget);
    }
  }
  return {budgets.begin(), budgets.end()};
}

}  // namespace cbc3d::reports

// Fronts: a figure of a mesher over the number of its elements, and meshers compared at equal elements.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "metrics/catalog.hpp"
#include "reports/results/columns.hpp"
#include "reports/results/run_values.hpp"

namespace cbc3d::reports {

/// The figures that are compared at equal elements, in the order of the tables.
std::span<const metrics::MetricId> front_figures();

/// A metric's figure in the unit in which it is shown, by its magnitude where more is worse: an error of
/// volume of -2 % is as bad as one of 2 %, a mean ratio of -.2 is not as good as one of .2.
FigureOf compared_figure(metrics::MetricId id);

/// A figure over the number of elements, known at some numbers.
class FrontCurve {
 public:
  using Points = std::vector<std::pair<double, double>>;  ///< elements, figure

  /// Points with the same number of elements become one, with their mean.
  explicit FrontCurve(Points points);

  /// The figure at a number of elements, interpolated in log-log, or linearly over the logarithm where a
  /// figure is not positive. Up to a tenth beyond the ends it is that of the end; none farther out.
  [[nodiscard]] std::optional<double> at(double elements) const;
  [[nodiscard]] const Points& points() const { return points_; }

 private:
  Points points_;
};

/// The curve of a metric (compared_figure) for a case and a column: the runs that are ok and have a budget,
/// repeats of a budget by their medians.
FrontCurve front_curve(const std::vector<JobResult>& results, const Columns& columns,
                       const std::string& case_name, const std::string& column, metrics::MetricId id);

/// The medians of two figures of the same runs.
struct FrontPoint {
  std::int64_t budget = 0;
  double x = 0, y = 0;
};

/// A point for each budget, in their order.
std::vector<FrontPoint> front_points(const std::vector<JobResult>& results, const Columns& columns,
                                     const std::string& case_name, const std::string& column,
                                     const FigureOf& x, const FigureOf& y);

/// By which factor a figure is worse than another: at least 1 when `value` is worse, infinite when the better
/// of two errors is 0 or the worse of two qualities is 0 or below. `worse` is higher or lower.
double times_worse(double value, double other, metrics::Worse worse);

/// A metric of a case at a budget for every column.
struct FrontComparison {
  std::string case_name;
  std::int64_t budget = 0;
  metrics::MetricId id{};
  std::vector<std::optional<double>> values;  ///< of the columns
  std::size_t best = 0;                       ///< column with the best value
  double best_value = 0;
  double lead = 1;         ///< by which factor the second best is worse
  bool has_rival = false;  ///< there is a second best
};

/// All comparisons of a run, by case, budget and figure; figures that no column has are left out.
std::vector<FrontComparison> front_comparisons(const std::vector<JobResult>& results, const Columns& columns);

/// Why the runs of a case, a budget and a column have no figure at the budget, or no mesh of that size: the
/// failure, else why the budget was not met; empty: there is such a mesh.
std::string shortfall_of(const Runs& runs);

/// The budgets of a case, ascending.
std::vector<std::int64_t> budgets_of(const std::vector<JobResult>& results, const std::string& case_name);

}  // namespace cbc3d::reports

#include "reports/tables/cells.hpp"

#include <algorithm>

#include "reports/statistics/robust.hpp"
#include "reports/tables/paper_figure.hpp"

namespace cbc3d::reports {
namespace {

/// Why a figure, or some run of it, is not there; empty when all runs are ok.
std::string missing_reason(const Runs& runs) {
  if (runs.empty()) {
    return "not run";
  }
  std::size_t failures = 0;
  std::string reason;
  for (const JobResult* run : runs) {
    if (!run->is_ok()) {
      ++failures;
      reason = failure_of(*run);
    }
  }
  const bool some = failures > 0 && failures < runs.size();
  return some ? std::to_string(failures) + " of " + std::to_string(runs.size()) + " runs " + reason : reason;
}

}  // namespace

Cell cell_of(const Runs& runs, const FigureOf& figure) {
  Cell cell;
  cell.reason = missing_reason(runs);
  const std::vector<double> values = values_of(runs, figure);
  if (!values.empty()) {
    cell.value = median(values);
    cell.lowest = *std::min_element(values.begin(), values.end());
    cell.highest = *std::max_element(values.begin(), values.end());
    cell.runs = static_cast<int>(values.size());
  }
  return cell;
}

Cell cell_of(const Runs& runs, metrics::MetricId id) {
  Cell cell = cell_of(runs, shown_figure(id));
  if (id == metrics::metric_id("time_s.mesh") && cell.value && cell.reason.empty() &&
      runs.front()->includes_files) {
    cell.reason = "whole process, reading and writing files included";
  }
  const JobResult* good = first_good(runs);
  if (!cell.value && good != nullptr && metrics::metric(id).key.starts_with("solver.")) {
    cell.reason = good->solver_reason;
  }
  return cell;
}

Row metric_row(const TableInput& input, const Columns& columns, const std::string& case_name,
               metrics::MetricId id) {
  const metrics::Metric& metric = metrics::metric(id);
  Row row{case_name, title(metric), metric.decimals, {}};
  for (const std::string& column : columns.names()) {
    const Runs runs = columns.runs(case_name, column);
    row.cells.push_back(cell_of(runs, id));
    row.cells.back().paper = paper_figure(input.cases, runs, metric.published);
  }
  return row;
}

std::vector<metrics::MetricId> metrics_of_table(std::string_view table) {
  std::vector<metrics::MetricId> ids;
  for (const metrics::MetricId id : metrics::all_metrics()) {
    if (is_shown_in(metrics::metric(id), table)) {
      ids.push_back(id);
    }
  }
  return ids;
}

}  // namespace cbc3d::reports

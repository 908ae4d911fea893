#include "reports/tables/target_table.hpp"

#include <algorithm>
#include <cmath>

#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

using metrics::Limit;
using metrics::Metric;
using metrics::MetricId;

constexpr const char* kName = "targets";

/// "min dihedral angle (deg), at least 20".
std::string title_with_target(const Metric& metric) {
  const double value = metric.target.value;
  switch (metric.target.limit) {
    case Limit::none:
      return title(metric);
    case Limit::at_least:
      return title(metric) + ", at least " + format_number(value, 0);
    case Limit::at_most:
      break;
  }
  return title(metric) + ", at most " + format_number(value, value == std::floor(value) ? 0 : 1);
}

/// "label 4", "labels 3, 5"; empty when there is none.
std::string labels_text(const std::vector<long>& labels) {
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t n = 0; n < std::min(kMost, labels.size()); ++n) {
    text += (n == 0 ? labels.size() == 1 ? "label " : "labels " : ", ") + std::to_string(labels[n]);
  }
  return labels.size() > kMost ? text + " and " + std::to_string(labels.size() - kMost) + " more" : text;
}

/// The labels in question in the first run that ended well.
std::string where_of(const Runs& runs, MetricId id) {
  const JobResult* good = first_good(runs);
  return good == nullptr || !good->worst_labels.contains(id) ? "" : labels_text(good->worst_labels.at(id));
}

Cell target_cell(const Runs& runs, MetricId id) {
  Cell cell = cell_of(runs, id);
  if (cell.value) {
    cell.missed = misses_target(metrics::metric(id), *cell.value);
    const bool is_count = metrics::metric(id).decimals == 0;
    cell.where = is_count && !cell.missed ? "" : where_of(runs, id);
  }
  return cell;
}

/// How many of a column's cells in these rows are missed.
Cell missed_cell(const std::vector<Row>& rows, std::size_t column) {
  int missed = 0, known = 0;
  std::string reason;
  for (const Row& row : rows) {
    missed += row.cells[column].missed ? 1 : 0;
    known += row.cells[column].value ? 1 : 0;
    reason = row.cells[column].reason;
  }
  Cell cell = known == 0 ? Cell{} : number_cell(missed, 0);
  cell.reason = reason;
  return cell;
}

std::vector<Row> case_rows(const Columns& columns, const std::string& case_name) {
  std::vector<Row> rows;
  for (const MetricId id : metrics_of_table(kName)) {
    Row row{case_name, title_with_target(metrics::metric(id)), metrics::metric(id).decimals, {}};
    for (const std::string& column : columns.names()) {
      row.cells.push_back(target_cell(columns.runs(case_name, column), id));
    }
    rows.push_back(std::move(row));
  }
  Row sum{case_name, "limits missed", 0, {}};
  for (std::size_t column = 0; column < columns.names().size(); ++column) {
    sum.cells.push_back(missed_cell(rows, column));
  }
  rows.push_back(std::move(sum));
  return rows;
}

}  // namespace

Table target_table(const TableInput& input) {
  const Columns columns(input.results);
  Table table{.name = kName,
              .title =
                  "What a good mesh should have (HD: the paper's Hausdorff distance; of the worst label, and "
                  "of all labels as one)",
              .columns = columns.names()};
  for (const std::string& case_name : case_names(input.results)) {
    for (Row& row : case_rows(columns, case_name)) {
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace cbc3d::reports

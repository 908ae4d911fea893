// Cells and rows of tables from figures of results.
#pragma once

#include <string>

#include "reports/results/columns.hpp"
#include "reports/results/run_values.hpp"
#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// The median of a figure over `runs`, the results of one case and column, with their range, or why there is
/// none.
Cell cell_of(const Runs& runs, const FigureOf& figure);

/// As above, of a metric in the unit in which it is shown. A time that includes reading and writing files
/// says so, and a solver's figure that is not there says why.
Cell cell_of(const Runs& runs, metrics::MetricId id);

/// A row of a metric for a case: a cell for every column, each with the published figure where there is one.
Row metric_row(const TableInput& input, const Columns& columns, const std::string& case_name,
               metrics::MetricId id);

/// The metrics that name a table in the catalog, in its order.
std::vector<metrics::MetricId> metrics_of_table(std::string_view table);

}  // namespace cbc3d::reports

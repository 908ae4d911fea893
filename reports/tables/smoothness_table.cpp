#include "reports/tables/smoothness_table.hpp"

#include <algorithm>

#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

using metrics::MetricId;

constexpr const char* kName = "smoothness";

/// The results of a case whose true shape is known.
Runs results_with_shape(const std::vector<JobResult>& results, const std::string& case_name) {
  Runs known;
  for (const JobResult& result : results) {
    if (row_name(result) == case_name && result.figures[metrics::metric_id("shape.normal_deviation_deg")]) {
      known.push_back(&result);
    }
  }
  return known;
}

/// The voxel faces have the same figures beside every mesh that has the same labels: the first that has most
/// is taken.
Cell voxel_cell(const Runs& runs, MetricId id) {
  const JobResult* most = *std::max_element(
      runs.begin(), runs.end(),
      [](const JobResult* a, const JobResult* b) { return a->labels_with_shape < b->labels_with_shape; });
  const auto& value = most->voxel_surface[id];
  return value ? number_cell(metrics::metric(id).scale * *value, metrics::metric(id).decimals) : Cell{};
}

}  // namespace

Table smoothness_table(const TableInput& input) {
  const Columns columns(input.results);
  Table table{.name = kName,
              .title = "Surfaces against the true shape, where that is known",
              .columns = columns.names()};
  for (const std::string& case_name : case_names(input.results)) {
    const Runs known = results_with_shape(input.results, case_name);
    for (const MetricId id : known.empty() ? std::vector<MetricId>{} : metrics_of_table(kName)) {
      table.rows.push_back(metric_row(input, columns, case_name, id));
      table.rows.back().cells.push_back(voxel_cell(known, id));
    }
  }
  table.columns.emplace_back("voxel surface");
  return table;
}

}  // namespace cbc3d::reports

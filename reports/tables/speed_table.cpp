#include "reports/tables/speed_table.hpp"

#include "reports/tables/cells.hpp"
#include "reports/tables/paper_figure.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::MetricId;

constexpr const char* kName = "speed";

std::optional<double> core_seconds(const JobResult& result) {
  const auto seconds = result.figures[metric_id("time_s.mesh")];
  const auto threads = result.figures[metric_id("threads")];
  return seconds && threads ? std::optional(*seconds * *threads) : std::nullopt;
}

/// The rows of one case.
class CaseRows {
 public:
  CaseRows(const TableInput& input, const Columns& columns, const std::string& case_name)
      : input_(input), columns_(columns), case_name_(case_name) {
    for (const std::string& name : columns.names()) runs_.push_back(columns.runs(case_name, name));
  }

  std::vector<Row> all() {
    for (const MetricId id : metrics_of_table(kName)) {
      rows_.push_back(metric_row(input_, columns_, case_name_, id));
    }
    for (std::size_t reference = 0; reference < runs_.size(); ++reference) {
      if (is_reference(reference)) {
        add_multiples(metric_id("elements"), reference);
        add_multiples(metric_id("time_s.mesh"), reference);
        add_multiples(metric_id("time_s.cpu"), reference);
      }
    }
    add_core_seconds();
    return std::move(rows_);
  }

 private:
  [[nodiscard]] bool is_reference(std::size_t column) const {
    const std::string mesher = runs_[column].empty() ? "" : runs_[column].front()->mesher;
    return mesher == "cbc3d" || mesher == "cbc3d-paper";
  }

  void add_multiples(MetricId id, std::size_t reference) {
    const auto base = median_of(runs_[reference], shown_figure(id));
    if (!base || *base <= 0 || runs_.size() < 2) return;
    const std::string name(metrics::metric(id).name);
    Row row{case_name_, name + " over " + columns_.names()[reference] + "'s", 2, {}};
    for (const Runs& runs : runs_) {
      const auto value = median_of(runs, shown_figure(id));
      row.cells.push_back(value ? number_cell(*value / *base, 2) : Cell{});
    }
    rows_.push_back(std::move(row));
  }

  void add_core_seconds() {
    Row ours{case_name_, "core-seconds (time x threads)", 2, {}};
    Row quotient{case_name_, "the paper's core-seconds over these", 1, {}};
    bool known = false;
    for (const Runs& runs : runs_) {
      Cell cell = cell_of(runs, core_seconds);
      const auto seconds = paper_figure(input_.cases, runs, "time_s"),
                 threads = paper_figure(input_.cases, runs, "threads");
      if (seconds && threads) cell.paper = *seconds * *threads;
      const bool both = cell.paper && cell.value && *cell.value > 0;
      quotient.cells.push_back(both ? number_cell(*cell.paper / *cell.value, 1) : Cell{});
      known = known || both;
      ours.cells.push_back(std::move(cell));
    }
    rows_.push_back(std::move(ours));
    if (known) rows_.push_back(std::move(quotient));
  }

  const TableInput& input_;
  const Columns& columns_;
  std::string case_name_;
  std::vector<Runs> runs_;  ///< of each column
  std::vector<Row> rows_;
};

}  // namespace

Table speed_table(const TableInput& input) {
  const Columns columns(input.results);
  Table table{.name = kName,
              .title =
                  "Speed (HD: the paper's Hausdorff distance; the paper's core-seconds: on its own image and "
                  "machine)",
              .columns = columns.names()};
  for (const std::string& case_name : case_names(input.results)) {
    for (Row& row : CaseRows(input, columns, case_name).all()) table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace cbc3d::reports

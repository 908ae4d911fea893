#include "reports/tables/speed_table.hpp"

#include <cstddef>

#include "reports/statistics/comparison.hpp"
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

std::string interval_text(const Interval& interval, int decimals) {
  return format_number(interval.low, decimals) + "-" + format_number(interval.high, decimals);
}

/// A comparison of times and the cell that says what it tells.
struct PlacedTest {
  std::size_t row, column;
  SamplePair samples;
};

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
      if (is_time(id)) add_interval(id);
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

  /// The comparisons of times that all() put into its rows, in their order.
  std::vector<PlacedTest> tests() { return std::move(tests_); }

 private:
  static bool is_time(MetricId id) { return id == metric_id("time_s.mesh") || id == metric_id("time_s.cpu"); }

  [[nodiscard]] bool is_reference(std::size_t column) const {
    const std::string mesher = runs_[column].empty() ? "" : runs_[column].front()->mesher;
    return mesher == "cbc3d" || mesher == "cbc3d-paper";
  }

  /// A row of intervals, where any column has one.
  void add_interval(MetricId id) {
    const metrics::Metric& metric = metrics::metric(id);
    Row row{case_name_, std::string(metric.name) + " (s): 95 % interval of the median", metric.decimals, {}};
    bool is_known = false;
    for (const Runs& runs : runs_) {
      const auto interval = median_interval(values_of(runs, shown_figure(id)));
      is_known = is_known || interval.has_value();
      row.cells.push_back(interval ? text_cell(interval_text(*interval, 3)) : Cell{});
    }
    if (is_known) rows_.push_back(std::move(row));
  }

  void add_multiples(MetricId id, std::size_t reference) {
    const std::vector<double> base = values_of(runs_[reference], shown_figure(id));
    const auto middle = median_of(runs_[reference], shown_figure(id));
    if (!middle || *middle <= 0 || runs_.size() < 2) return;
    const std::string name(metrics::metric(id).name);
    Row row{case_name_, name + " over " + columns_.names()[reference] + "'s", 2, {}};
    for (std::size_t column = 0; column < runs_.size(); ++column) {
      std::vector<double> values = values_of(runs_[column], shown_figure(id));
      const auto value = median_of(runs_[column], shown_figure(id));
      row.cells.push_back(value ? number_cell(*value / *middle, 2) : Cell{});
      if (is_time(id) && value && column != reference) {
        tests_.push_back({rows_.size(), column, {std::move(values), base}});
      }
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
  std::vector<PlacedTest> tests_;
};

/// Says in the cells what the tests of the whole table, as one family, tell.
void say_findings(Table& table, const std::vector<PlacedTest>& tests) {
  std::vector<SamplePair> pairs;
  pairs.reserve(tests.size());
  for (const PlacedTest& test : tests) pairs.push_back(test.samples);
  const std::vector<Comparison> found = compare_samples(pairs, kTableLevel);
  for (std::size_t n = 0; n < tests.size(); ++n) {
    const auto& interval = found[n].ratio_interval;
    table.rows[tests[n].row].cells[tests[n].column].where =
        (interval ? interval_text(*interval, 2) + "; " : "") + time_finding(found[n]);
  }
}

}  // namespace

Table speed_table(const TableInput& input) {
  const Columns columns(input.results);
  Table table{.name = kName,
              .title =
                  "Speed (HD: the paper's Hausdorff distance; the paper's core-seconds: on its own image and "
                  "machine; times over others' with the 95 % interval of the ratio of medians; slower and "
                  "faster by the rank test at .05 after Holm, A the probability of being slower)",
              .columns = columns.names()};
  std::vector<PlacedTest> tests;
  for (const std::string& case_name : case_names(input.results)) {
    CaseRows rows(input, columns, case_name);
    const std::size_t first = table.rows.size();
    for (Row& row : rows.all()) table.rows.push_back(std::move(row));
    for (PlacedTest& test : rows.tests()) {
      test.row += first;
      tests.push_back(std::move(test));
    }
  }
  say_findings(table, tests);
  return table;
}

}  // namespace cbc3d::reports

#include "reports/tables/front_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/results/front.hpp"
#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;

constexpr const char* kOurs = "cbc3d";
constexpr const char* kAlone = "no other mesh";
/// Factors that show as 1.00 are none.
constexpr double kLeastLoss = 1.005;

std::string budget_name(const std::string& case_name, std::int64_t budget) {
  return case_name + ", " + format_number(static_cast<double>(budget), 0) + " elements";
}

/// Why there is no figure at a budget: the solver's reason where the mesh is there and was not solved.
std::string reason_of(const Runs& runs, const metrics::Metric& metric) {
  const JobResult* good = first_good(runs);
  return good != nullptr && metric.key.starts_with("solver.") && !good->solver_reason.empty()
             ? good->solver_reason
             : shortfall_of(runs);
}

Cell factor_cell(double factor, metrics::Worse worse) {
  if (std::isinf(factor)) {
    return text_cell(worse == metrics::Worse::lower ? "infinite: this is 0 or below"
                                                    : "infinite: the best has 0");
  }
  return number_cell(factor, 2);
}

/// The column of cbc3d; of several thread counts the first.
std::optional<std::size_t> our_column(const std::vector<JobResult>& results, const Columns& columns) {
  for (std::size_t column = 0; column < columns.names().size(); ++column) {
    for (const JobResult& result : results) {
      if (result.mesher == kOurs && columns.name_of(result) == columns.names()[column]) {
        return column;
      }
    }
  }
  return std::nullopt;
}

/// By which factor a column is worse than the best; infinite without a figure.
double loss_of(const FrontComparison& row, std::size_t column) {
  const auto& value = row.values[column];
  return value ? times_worse(*value, row.best_value, metrics::metric(row.id).worse)
               : std::numeric_limits<double>::infinity();
}

Cell loss_cell(const FrontComparison& row, std::size_t column) {
  if (!row.values[column]) {
    return text_cell("no such mesh");
  }
  return row.has_rival ? factor_cell(loss_of(row, column), metrics::metric(row.id).worse) : text_cell(kAlone);
}

class FrontRows {
 public:
  explicit FrontRows(const TableInput& input)
      : columns_(input.results),
        rows_(front_comparisons(input.results, columns_)),
        ours_(our_column(input.results, columns_)) {}

  [[nodiscard]] const Columns& columns() const { return columns_; }
  [[nodiscard]] const std::vector<FrontComparison>& rows() const { return rows_; }
  [[nodiscard]] std::optional<std::size_t> ours() const { return ours_; }

  /// Elements of the meshes that were made for a budget.
  [[nodiscard]] Row count_row(const std::string& case_name, std::int64_t budget) const {
    Row row{budget_name(case_name, budget), "elements of the mesh", 0, {}};
    for (const std::string& column : columns_.names()) {
      const Runs runs = columns_.runs(row.case_name, column);
      row.cells.push_back(cell_of(runs, metric_id("elements")));
      row.cells.back().reason = shortfall_of(runs);
    }
    row.cells.resize(columns_.names().size() + 2 + (ours_ ? 1 : 0), text_cell(""));
    return row;
  }

  [[nodiscard]] Row figure_row(const FrontComparison& compared) const {
    const metrics::Metric& metric = metrics::metric(compared.id);
    Row row{budget_name(compared.case_name, compared.budget), title(metric), metric.decimals, {}};
    for (std::size_t column = 0; column < compared.values.size(); ++column) {
      const auto& value = compared.values[column];
      row.cells.push_back(value ? number_cell(*value, metric.decimals) : Cell{});
      if (!value) {
        row.cells.back().reason = reason_of(columns_.runs(row.case_name, columns_.names()[column]), metric);
      }
    }
    row.cells.push_back(text_cell(columns_.names()[compared.best]));
    row.cells.push_back(compared.has_rival ? factor_cell(compared.lead, metric.worse) : text_cell(kAlone));
    if (ours_) {
      row.cells.push_back(loss_cell(compared, *ours_));
    }
    return row;
  }

 private:
  Columns columns_;
  std::vector<FrontComparison> rows_;
  std::optional<std::size_t> ours_;
};

Row loss_row(const FrontRows& front, std::size_t ours, const FrontComparison& compared) {
  const metrics::Metric& metric = metrics::metric(compared.id);
  const Row row = front.figure_row(compared);
  const std::string& best = front.columns().names()[compared.best];
  return {row.case_name,
          row.figure,
          metric.decimals,
          {row.cells[ours], row.cells[compared.best], text_cell(best), loss_cell(compared, ours)}};
}

}  // namespace

Table front_table(const TableInput& input) {
  const FrontRows front(input);
  Table table{.name = "front",
              .title = "Meshers at equal elements (figures interpolated in log-log to the budget)",
              .columns = front.columns().names()};
  table.columns.insert(table.columns.end(), {"best", "second best over best"});
  if (front.ours()) {
    table.columns.emplace_back("cbc3d over best");
  }
  const FrontComparison* before = nullptr;
  for (const FrontComparison& compared : front.rows()) {
    const bool is_next =
        before == nullptr || before->case_name != compared.case_name || before->budget != compared.budget;
    if (is_next) {
      table.rows.push_back(front.count_row(compared.case_name, compared.budget));
    }
    table.rows.push_back(front.figure_row(compared));
    before = &compared;
  }
  return table;
}

Table front_loss_table(const TableInput& input) {
  const FrontRows front(input);
  Table table{.name = "front_losses",
              .title = "Where cbc3d loses at equal elements, the worst first",
              .columns = {"cbc3d", "best", "best mesher", "cbc3d over best"}};
  const auto ours = front.ours();
  if (!ours) {
    return table;
  }
  std::vector<std::pair<double, const FrontComparison*>> losses;
  for (const FrontComparison& compared : front.rows()) {
    if (const double loss = loss_of(compared, *ours); loss >= kLeastLoss) {
      losses.emplace_back(loss, &compared);
    }
  }
  std::stable_sort(losses.begin(), losses.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [loss, compared] : losses) {
    table.rows.push_back(loss_row(front, *ours, *compared));
  }
  return table;
}

}  // namespace cbc3d::reports

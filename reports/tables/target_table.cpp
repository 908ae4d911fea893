#include "reports/tables/target_table.hpp"

#include <algorithm>
#include <cmath>

#include "reports/results/front.hpp"
#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

using metrics::Metric;
using metrics::MetricId;
using metrics::Purpose;

constexpr Purpose kPurposes[] = {Purpose::distance, Purpose::smooth, Purpose::shape, Purpose::solver,
                                 Purpose::topology, Purpose::labels, Purpose::count, Purpose::time};

/// "label 4", "labels 3, 5", "right lung (4)"; empty when there is none.
std::string labels_text(const std::vector<long>& labels, const LabelNames& names) {
  if (labels.size() == 1) {
    return names.text(static_cast<Label>(labels[0]));
  }
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t n = 0; n < std::min(kMost, labels.size()); ++n) {
    text += (n == 0 ? "labels " : ", ") + std::to_string(labels[n]);
  }
  return labels.size() > kMost ? text + " and " + std::to_string(labels.size() - kMost) + " more" : text;
}

/// The labels in question in the first run that ended well.
std::string where_of(const Runs& runs, MetricId id) {
  const JobResult* good = first_good(runs);
  return good == nullptr || !good->worst_labels.contains(id)
             ? ""
             : labels_text(good->worst_labels.at(id), good->image ? good->image->names : LabelNames());
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

/// "0.52 mm".
std::string with_unit(double value, const Metric& metric) {
  const std::string unit(metric.unit);
  return format_number(value, metric.decimals) + (unit.empty() ? "" : " " + unit);
}

constexpr MetricId kElements = metrics::metric_id("summary.elements");

/// The meshes that are compared with each other: those of a case, or of a budget of it.
struct Group {
  std::string name;  ///< of the rows
  std::string case_name;
  std::optional<std::int64_t> budget;
};

std::vector<Group> groups_of(const std::vector<JobResult>& results) {
  std::vector<Group> groups;
  for (const std::string& name : case_names(results)) {
    const auto first = std::find_if(results.begin(), results.end(),
                                    [&](const JobResult& result) { return row_name(result) == name; });
    groups.push_back({name, first->case_name, first->budget});
  }
  return groups;
}

/// The results in their columns.
struct Compared {
  const std::vector<JobResult>& results;
  const Columns& columns;
};

/// The figure of the meshes themselves.
Cell own_cell(const Compared& all, const Group& group, const std::string& column, MetricId id) {
  const Runs runs = all.columns.runs(group.name, column);
  Cell cell = cell_of(runs, id);
  cell.where = cell.value ? where_of(runs, id) : "";
  if (group.budget && cell.reason.empty()) {
    cell.reason = shortfall_of(runs);
  }
  return cell;
}

/// The figure at exactly the budget, where there is one.
Cell cell_at_budget(const Compared& all, const Group& group, const std::string& column, MetricId id) {
  const FrontCurve curve = front_curve(all.results, all.columns, group.case_name, column, id);
  const auto value = curve.at(static_cast<double>(group.budget.value()));
  const Cell own = own_cell(all, group, column, id);
  Cell cell = value ? number_cell(*value, -1) : Cell{};
  cell.reason = own.reason;
  cell.where = value ? own.where : "";
  return cell;
}

Cell compared_cell(const Compared& all, const Group& group, const std::string& column, MetricId id) {
  return group.budget && id != kElements ? cell_at_budget(all, group, column, id)
                                         : own_cell(all, group, column, id);
}

/// A metric of one group: the figures of all columns, and the best of them.
class Comparison {
 public:
  Comparison(const Group& group, MetricId id, std::vector<Cell> cells)
      : metric_(metrics::metric(id)), case_name_(group.name), cells_(std::move(cells)) {
    for (Cell& cell : cells_) {
      cell = without_signs(std::move(cell));
      add_to_best(cell);
    }
  }

  /// True where some column has the figure.
  [[nodiscard]] bool is_measured() const { return best_.has_value(); }

  [[nodiscard]] Row row() const {
    const std::string name = metrics::words(metric_.purpose) + (": " + title(metric_));
    if (!is_measured() || best_.value() >= least_shown()) {
      Row row{case_name_, name, 2, {}};
      for (const Cell& cell : cells_) row.cells.push_back(multiple_of_best(cell));
      return row;
    }
    const std::string best =
        std::abs(best_.value()) < least_shown() ? "0" : with_unit(best_.value(), metric_);
    return {case_name_, name + ", itself (the best is " + best + ")", metric_.decimals, cells_};
  }

  /// The counts of a hard fault.
  [[nodiscard]] Row faults() const {
    Row row{case_name_, std::string(metrics::words(metric_.purpose)) + ": " + title(metric_), 0, cells_};
    for (Cell& cell : row.cells) {
      cell.missed = cell.value.value_or(0) > 0;
      cell.missed_word = "";
    }
    return row;
  }

 private:
  /// Below half of the last digit that is shown a figure counts as 0: a multiple of rounding errors says
  /// nothing.
  [[nodiscard]] double least_shown() const { return 0.5 * std::pow(10.0, -metric_.decimals); }
  [[nodiscard]] bool is_lower_worse() const { return metric_.worse == metrics::Worse::lower; }

  /// Signed figures, such as errors of volume, count by their magnitude; a measure of which 1 is best does
  /// not.
  [[nodiscard]] Cell without_signs(Cell cell) const {
    if (cell.value && !is_lower_worse()) {
      const double a = std::abs(cell.lowest), b = std::abs(cell.highest);
      const bool crosses = cell.lowest < 0 && cell.highest > 0;
      cell.value = std::abs(*cell.value);
      cell.lowest = crosses ? 0 : std::min(a, b);
      cell.highest = std::max(a, b);
    }
    return cell;
  }

  void add_to_best(const Cell& cell) {
    if (cell.value && (!best_ || (is_lower_worse() ? *cell.value > *best_ : *cell.value < *best_))) {
      best_ = cell.value;
    }
  }

  [[nodiscard]] double multiple(double value) const {
    return is_lower_worse() ? best_.value() / value : value / best_.value();
  }

  [[nodiscard]] Cell multiple_of_best(const Cell& cell) const {
    Cell result = cell;
    if (!cell.value) return result;
    const std::string figure = with_unit(*cell.value, metric_);
    result.where = joined(figure, cell.where);
    if (cell.lowest <= 0 && is_lower_worse()) {
      result.text = joined(figure + ", no multiple", cell.where);
      return result;
    }
    const auto [lowest, highest] = std::minmax(multiple(cell.lowest), multiple(cell.highest));
    result.value = multiple(*cell.value);
    result.lowest = lowest;
    result.highest = highest;
    return result;
  }

  const Metric& metric_;
  std::string case_name_;
  std::vector<Cell> cells_;
  std::optional<double> best_;
};

/// How many kinds of hard faults a column has.
Cell kinds_cell(const std::vector<Row>& rows, std::size_t column) {
  int kinds = 0, known = 0;
  for (const Row& row : rows) {
    kinds += row.cells[column].missed ? 1 : 0;
    known += row.cells[column].value ? 1 : 0;
  }
  Cell cell = known == 0 ? Cell{} : number_cell(kinds, 0);
  cell.reason = rows.back().cells[column].reason;
  return cell;
}

std::vector<Cell> compared_cells(const Compared& all, const Group& group, MetricId id) {
  std::vector<Cell> cells;
  for (const std::string& column : all.columns.names()) {
    cells.push_back(compared_cell(all, group, column, id));
  }
  return cells;
}

std::vector<Row> purpose_rows(const Compared& all, const Group& group) {
  std::vector<Row> rows;
  for (const Purpose purpose : kPurposes) {
    for (const MetricId id : metrics::all_metrics()) {
      if (metrics::metric(id).purpose == purpose) {
        const Comparison comparison(group, id, compared_cells(all, group, id));
        // Where no solver was asked its rows would be dashes alone.
        if (purpose != Purpose::solver || comparison.is_measured()) rows.push_back(comparison.row());
      }
    }
  }
  return rows;
}

std::vector<Row> fault_rows(const Compared& all, const Group& group) {
  std::vector<Row> rows;
  for (const MetricId id : metrics::all_metrics()) {
    if (metrics::metric(id).purpose == Purpose::hard_fault) {
      std::vector<Cell> cells;
      for (const std::string& column : all.columns.names()) {
        cells.push_back(own_cell(all, group, column, id));
      }
      rows.push_back(Comparison(group, id, std::move(cells)).faults());
    }
  }
  Row sum{group.name, "hard faults, kinds", 0, {}};
  for (std::size_t column = 0; column < all.columns.names().size(); ++column) {
    sum.cells.push_back(kinds_cell(rows, column));
  }
  rows.push_back(std::move(sum));
  return rows;
}

/// "nidus: 12,345 (cbc3d), 98,765 (cgal)"; empty where the group has no two meshes.
std::string counts_text(const Compared& all, const Group& group) {
  std::string text;
  int meshes = 0;
  for (const std::string& column : all.columns.names()) {
    if (const Cell cell = own_cell(all, group, column, kElements); cell.value) {
      text += (meshes++ == 0 ? "" : ", ") + format_number(*cell.value, 0) + " (" + column + ")";
    }
  }
  return meshes < 2 ? "" : group.name + ": " + text;
}

std::string title_of(const Compared& all, const std::vector<Group>& groups) {
  std::string unequal;
  bool has_budgets = false;
  for (const Group& group : groups) {
    has_budgets = has_budgets || group.budget.has_value();
    if (const std::string counts = group.budget ? "" : counts_text(all, group); !counts.empty()) {
      unequal += (unequal.empty() ? "" : "; ") + counts;
    }
  }
  return "Every figure as a multiple of the best one's of the meshers compared here (1 is best; the figure "
         "in brackets), "
         "and the hard faults of the meshes themselves" +
         std::string(has_budgets ? ". Figures at a budget are interpolated to exactly so many elements"
                                 : "") +
         (unequal.empty() ? "" : ". Not at equal elements, which are: " + unequal);
}

}  // namespace

Table target_table(const TableInput& input) {
  const Columns columns(input.results);
  const Compared all{input.results, columns};
  const std::vector<Group> groups = groups_of(input.results);
  Table table{.name = "targets", .title = title_of(all, groups), .columns = columns.names()};
  for (const Group& group : groups) {
    for (const auto& rows : {purpose_rows(all, group), fault_rows(all, group)}) {
      table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    }
  }
  return table;
}

}  // namespace cbc3d::reports

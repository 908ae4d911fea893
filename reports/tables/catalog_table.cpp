#include "reports/tables/catalog_table.hpp"

#include <algorithm>

#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

bool is_mixed(const JobResult& result) {
  using metrics::metric_id;
  return result.figures[metric_id("elements")].value_or(0) >
         result.figures[metric_id("counts.tets")].value_or(0);
}

/// Solved, or with a reason why not.
bool was_solved(const JobResult& result) {
  using metrics::metric_id;
  return result.figures[metric_id("solver.poisson_p1.h1_relative")] ||
         result.figures[metric_id("solver.poisson_p2.h1_relative")] || !result.solver_reason.empty();
}

}  // namespace

TableBuilder catalog_table(const std::string& name, const std::string& title) {
  return [name, title](const TableInput& input) {
    const Columns columns(input.results);
    Table table{.name = name, .title = title, .columns = columns.names()};
    for (const std::string& case_name : case_names(input.results)) {
      for (const metrics::MetricId id : metrics_of_table(name)) {
        table.rows.push_back(metric_row(input, columns, case_name, id));
      }
    }
    return table;
  };
}

TableBuilder for_solved_meshes(const TableBuilder& table) {
  return [table](const TableInput& input) {
    return std::any_of(input.results.begin(), input.results.end(), was_solved) ? table(input) : Table{};
  };
}

TableBuilder for_mixed_meshes(const TableBuilder& table) {
  return [table](const TableInput& input) {
    return std::any_of(input.results.begin(), input.results.end(), is_mixed) ? table(input) : Table{};
  };
}

}  // namespace cbc3d::reports

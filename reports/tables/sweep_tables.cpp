#include "reports/tables/sweep_tables.hpp"

#include <algorithm>
#include <cmath>

#include "reports/sweep/sweep.hpp"

namespace cbc3d::reports {
namespace {

std::string row_name(const SweepPoint& point) {
  return point.mesher + ", " + std::to_string(point.threads) + (point.threads == 1 ? " thread" : " threads");
}

std::string with_error(const Ratio& ratio) {
  return std::isfinite(ratio.value) ? format_number(ratio.value, 2) + " ± " + format_number(ratio.error, 2)
                                    : "-";
}

Cell outlier_cell(const Samples& samples) {
  std::string text;
  for (std::size_t n = 0; n < samples.outlier.size(); ++n) {
    if (samples.outlier[n]) {
      text += (text.empty() ? "" : ", ") + format_number(samples.seconds[n], 3) + " (#" +
              std::to_string(n + 1) + ")";
    }
  }
  return text_cell(text.empty() ? "none" : text);
}

Row sweep_row(const SweepPoint& point) {
  Row row{point.case_name, row_name(point), 3, {}};
  if (point.total.seconds.empty()) {
    row.cells.assign(7, Cell{});
    row.cells[0].reason = point.failure;
    return row;
  }
  const auto [lowest, highest] = std::minmax_element(point.total.seconds.begin(), point.total.seconds.end());
  row.cells = {number_cell(point.total.median_s, 3),
               number_cell(point.total.spread_s, 3),
               text_cell(format_number(*lowest, 3) + "-" + format_number(*highest, 3)),
               number_cell(static_cast<double>(point.total.seconds.size()), 0),
               text_cell(point.has_speed_up ? with_error(point.speed_up) : "1"),
               text_cell(point.has_speed_up ? with_error(point.efficiency) : "1"),
               outlier_cell(point.total)};
  row.cells[0].reason = point.failure;
  return row;
}

}  // namespace

Table sweep_table(const TableInput& input) {
  Table table{
      "sweep",
      "Sweep over threads (meshing end to end; speed-up over the fewest threads, with standard error)",
      {"median (s)", "spread (s)", "range (s)", "samples", "speed-up", "efficiency", "outliers (s)"},
      {},
      "case",
      "mesher"};
  for (const SweepPoint& point : points_of_sweep(input.folder, input.results)) {
    table.rows.push_back(sweep_row(point));
  }
  return table;
}

Table sweep_stage_table(const TableInput& input) {
  Table table{
      "sweep_stages",
      "Stages over threads: median seconds, spread, share of the job and speed-up with standard error",
      {"median (s)", "spread (s)", "share (%)", "speed-up", "outliers"},
      {},
      "case, mesher",
      "stage"};
  for (const SweepPoint& point : points_of_sweep(input.folder, input.results)) {
    for (std::size_t n = 0; n < point.stages.size(); ++n) {
      const auto& [name, samples] = point.stages[n];
      const double share = point.total.median_s > 0 ? 100 * samples.median_s / point.total.median_s : 0;
      table.rows.push_back(
          {point.case_name + ", " + row_name(point),
           name,
           3,
           {number_cell(samples.median_s, 4), number_cell(samples.spread_s, 4), number_cell(share, 1),
            text_cell(point.has_speed_up ? with_error(point.stage_speed_ups[n]) : "1"),
            outlier_cell(samples)}});
    }
  }
  return table;
}

}  // namespace cbc3d::reports

#include "reports/tables/sweep_tables.hpp"

#include <algorithm>
#include <cmath>

#include "reports/statistics/comparison.hpp"
#include "reports/sweep/sweep.hpp"

namespace cbc3d::reports {
namespace {

std::string row_name(const SweepPoint& point) {
  return point.mesher + ", " + std::to_string(point.threads) + (point.threads == 1 ? " thread" : " threads");
}

std::string interval_text(const std::optional<Interval>& interval, int decimals) {
  return interval ? format_number(interval->low, decimals) + "-" + format_number(interval->high, decimals)
                  : "too few samples";
}

std::string with_error(const Ratio& ratio) {
  return std::isfinite(ratio.value) ? format_number(ratio.value, 2) + " ± " + format_number(ratio.error, 2)
                                    : "-";
}

/// What is told of a point's times beside those of the fewest threads: "1.60 (1.52-1.66; faster, A 0.00)".
using SpeedUps = std::vector<std::string>;

const SweepPoint* base_of(const SweepPoint& point, const std::vector<SweepPoint>& points) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const SweepPoint& other) {
    return other.case_name == point.case_name && other.mesher == point.mesher &&
           other.threads == point.base_threads;
  });
  return point.has_speed_up && found != points.end() ? &*found : nullptr;
}

std::string speed_up_text(const Comparison& found, const SweepPoint& point) {
  const auto& times = found.ratio_interval;  // of times, so that its ends change places
  const bool is_known = times && times->low > 0;
  return format_number(point.speed_up.value, 2) + " (" +
         (is_known ? interval_text(Interval{1 / times->high, 1 / times->low}, 2) + "; " : "") +
         time_finding(found) + ")";
}

/// For every point; the tests of all points are one family.
SpeedUps speed_ups_of(const std::vector<SweepPoint>& points) {
  std::vector<SamplePair> pairs;
  for (const SweepPoint& point : points) {
    const SweepPoint* base = base_of(point, points);
    pairs.push_back(base == nullptr ? SamplePair{} : SamplePair{point.total.seconds, base->total.seconds});
  }
  const std::vector<Comparison> found = compare_samples(pairs, kTableLevel);
  SpeedUps texts;
  for (std::size_t n = 0; n < points.size(); ++n) {
    texts.push_back(points[n].has_speed_up ? speed_up_text(found[n], points[n]) : "1");
  }
  return texts;
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

Row sweep_row(const SweepPoint& point, const std::string& speed_up) {
  Row row{point.case_name, row_name(point), 3, {}};
  if (point.total.seconds.empty()) {
    row.cells.assign(7, Cell{});
    row.cells[0].reason = point.failure;
    return row;
  }
  const auto [lowest, highest] = std::minmax_element(point.total.seconds.begin(), point.total.seconds.end());
  row.cells = {number_cell(point.total.median_s, 3),
               text_cell(interval_text(median_interval(point.total.seconds), 3)),
               text_cell(format_number(*lowest, 3) + "-" + format_number(*highest, 3)),
               number_cell(static_cast<double>(point.total.seconds.size()), 0),
               text_cell(speed_up),
               text_cell(point.has_speed_up ? with_error(point.efficiency) : "1"),
               outlier_cell(point.total)};
  row.cells[0].reason = point.failure;
  return row;
}

}  // namespace

Table sweep_table(const TableInput& input) {
  Table table{
      "sweep",
      "Sweep over threads (meshing end to end; speed-up over the fewest threads with its 95 % interval; "
      "faster "
      "and slower by the rank test at .05 after Holm, A the probability of being slower)",
      {"median (s)", "95 % interval (s)", "range (s)", "samples", "speed-up", "efficiency", "outliers (s)"},
      {},
      "case",
      "mesher"};
  const std::vector<SweepPoint> points = points_of_sweep(input.folder, input.results);
  const SpeedUps speed_ups = speed_ups_of(points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    table.rows.push_back(sweep_row(points[n], speed_ups[n]));
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

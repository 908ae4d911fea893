// Tables and plots of a sweep, and the table of microbenchmarks beside them.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "mesher/core/error.hpp"
#include "reports/charts/chart.hpp"
#include "reports/sweep/parallel_table.hpp"
#include "reports/sweep/sweep.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

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

Table stage_table(const std::vector<SweepPoint>& points) {
  Table table{
      "sweep_stages",
      "Stages over threads: median seconds, spread, share of the job and speed-up with standard error",
      {"median (s)", "spread (s)", "share (%)", "speed-up", "outliers"},
      {},
      "case, mesher",
      "stage"};
  for (const SweepPoint& point : points) {
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

std::vector<int> thread_counts(const std::vector<SweepPoint>& points) {
  std::set<int> counts;
  for (const SweepPoint& point : points) {
    counts.insert(point.threads);
  }
  return {counts.begin(), counts.end()};
}

Chart empty_chart(const std::vector<int>& threads, const std::string& title, const std::string& y_title) {
  Chart chart;
  chart.title = title;
  chart.x_title = "threads";
  chart.y_title = y_title;
  for (const int count : threads) {
    chart.categories.push_back(std::to_string(count));
  }
  return chart;
}

/// A series over the threads for every mesher of a case; `value` gives value and error of a point.
template <class Value>
void add_meshers(Chart& chart, const std::vector<int>& threads, const std::vector<SweepPoint>& points,
                 const std::string& case_name, Value value) {
  for (const SweepPoint& point : points) {
    if (point.case_name != case_name || point.total.seconds.empty()) {
      continue;
    }
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const Series& candidate) { return candidate.name == point.mesher; });
    if (series == chart.series.end()) {
      const std::vector<double> none(threads.size(), kNone);
      series = chart.series.insert(chart.series.end(),
                                   {point.mesher, none, std::vector<double>(threads.size(), 0), false});
    }
    const auto at =
        static_cast<std::size_t>(std::find(threads.begin(), threads.end(), point.threads) - threads.begin());
    std::tie(series->values[at], series->errors[at]) = value(point);
  }
}

void add_case_figures(std::vector<Figure>& figures, const std::vector<SweepPoint>& points,
                      const std::string& case_name) {
  const std::vector<int> threads = thread_counts(points);
  Chart times = empty_chart(threads, case_name + ": time over threads", "median time (s)");
  times.note = "Bars: spread of the samples (1.4826 x median absolute deviation)";
  times.logarithmic = true;
  add_meshers(times, threads, points, case_name,
              [](const SweepPoint& p) { return std::pair(p.total.median_s, p.total.spread_s); });
  figures.push_back({"sweep-time-" + case_name, times.title, line_chart(times)});
  Chart speed_up = empty_chart(threads, case_name + ": speed-up over threads", "speed-up");
  speed_up.note = "Bars: standard error. Dashed: as many times faster as threads";
  add_meshers(speed_up, threads, points, case_name,
              [](const SweepPoint& p) { return std::pair(p.speed_up.value, p.speed_up.error); });
  Series ideal{"ideal", {}, {}, true};
  for (const int count : threads) {
    ideal.values.push_back(static_cast<double>(count) / threads.front());
  }
  speed_up.series.push_back(ideal);
  figures.push_back({"sweep-speed-up-" + case_name, speed_up.title, line_chart(speed_up)});
}

void add_stage_figure(std::vector<Figure>& figures, const std::vector<SweepPoint>& points,
                      const std::string& case_name, const std::string& mesher) {
  Chart chart;
  chart.title = case_name + ", " + mesher + ": stages";
  chart.x_title = "stage";
  chart.y_title = "median time (s)";
  chart.note = "Bars: spread of the samples";
  for (const SweepPoint& point : points) {
    if (point.case_name != case_name || point.mesher != mesher || point.stages.empty()) {
      continue;
    }
    if (chart.categories.empty()) {
      for (const auto& stage : point.stages) {
        chart.categories.push_back(stage.first);
      }
    }
    Series series{
        std::to_string(point.threads) + (point.threads == 1 ? " thread" : " threads"), {}, {}, false};
    for (const std::string& name : chart.categories) {
      const auto stage = std::find_if(point.stages.begin(), point.stages.end(),
                                      [&](const auto& candidate) { return candidate.first == name; });
      series.values.push_back(stage == point.stages.end() ? kNone : stage->second.median_s);
      series.errors.push_back(stage == point.stages.end() ? 0 : stage->second.spread_s);
    }
    chart.series.push_back(std::move(series));
  }
  if (chart.categories.size() > 1) {
    figures.push_back({"sweep-stages-" + case_name + "-" + mesher, chart.title, bar_chart(chart)});
  }
}

double nanoseconds(const Json& benchmark, const char* key) {
  const std::string unit = benchmark.value("time_unit", "ns");
  const double factor = unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1;
  return factor * benchmark.value(key, kNone);
}

}  // namespace

std::vector<Table> sweep_tables(const std::vector<SweepPoint>& points) {
  Table table{
      "sweep",
      "Sweep over threads (meshing end to end; speed-up over the fewest threads, with standard error)",
      {"median (s)", "spread (s)", "range (s)", "samples", "speed-up", "efficiency", "outliers (s)"},
      {},
      "case",
      "mesher"};
  for (const SweepPoint& point : points) {
    table.rows.push_back(sweep_row(point));
  }
  std::vector<Table> tables{table};
  Table stages = stage_table(points);
  if (!stages.rows.empty()) {
    tables.push_back(std::move(stages));
  }
  if (Table parallel = parallel_table(points); !parallel.rows.empty()) {
    tables.push_back(std::move(parallel));
  }
  return tables;
}

std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points) {
  std::vector<Figure> figures;
  std::set<std::string> cases;
  std::set<std::pair<std::string, std::string>> stages;
  for (const SweepPoint& point : points) {
    if (cases.insert(point.case_name).second) {
      add_case_figures(figures, points, point.case_name);
    }
    if (!point.stages.empty() && stages.insert({point.case_name, point.mesher}).second) {
      add_stage_figure(figures, points, point.case_name, point.mesher);
    }
  }
  return figures;
}

Json read_microbenchmarks(const std::vector<std::filesystem::path>& files) {
  Json all{{"benchmarks", Json::array()}};
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file);
    const Json content = stream ? Json::parse(stream, nullptr, false) : Json();
    const Json list = figure(content, {"benchmarks"});
    if (!list.is_array()) {
      throw InputError(
          "'" + file.string() +
          "' holds no list \"benchmarks\"; give the file of Google Benchmark's --benchmark_out with "
          "--benchmark_out_format=json");
    }
    for (const Json& benchmark : list) {
      all["benchmarks"].push_back(benchmark);
    }
  }
  return all;
}

Table microbenchmark_table(const Json& microbenchmarks) {
  Table table{"microbenchmarks",
              "Microbenchmarks (Google Benchmark)",
              {"wall time (ms)", "CPU time (ms)", "iterations", "items per second", "bytes per second",
               "of the memory's bandwidth (%)"},
              {},
              "benchmark",
              "kind"};
  for (const Json& benchmark : microbenchmarks["benchmarks"]) {
    Row row{benchmark.value("name", "?"),
            benchmark.value("aggregate_name", benchmark.value("run_type", "")),
            3,
            {}};
    for (const char* key : {"real_time", "cpu_time"}) {
      const double value = nanoseconds(benchmark, key) * 1e-6;
      row.cells.push_back(std::isfinite(value) ? number_cell(value, 3) : Cell{});
    }
    for (const char* key : {"iterations", "items_per_second", "bytes_per_second"}) {
      row.cells.push_back(figure(benchmark, {key}).is_number() ? number_cell(benchmark[key].get<double>(), 0)
                                                               : Cell{});
    }
    const Json share = figure(benchmark, {"of_bandwidth"});
    row.cells.push_back(share.is_number() ? number_cell(100 * share.get<double>(), 2) : Cell{});
    if (benchmark.value("error_occurred", false)) {
      row.cells.front().reason = benchmark.value("error_message", "failed");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace cbc3d::reports

#include "reports/tables/microbenchmark_table.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double nanoseconds(const Json& benchmark, const char* key) {
  const std::string unit = benchmark.value("time_unit", "ns");
  const double factor = unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1;
  return factor * benchmark.value(key, kNone);
}

}  // namespace

Json read_microbenchmarks(const std::vector<std::filesystem::path>& files) {
  Json all{{"benchmarks", Json::array()}};
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file);
    const Json content = json_object_or_empty<Json>(stream);
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

Table microbenchmarks_of_run(const TableInput& input) {
  const std::filesystem::path file = input.folder / "microbenchmarks.json";
  return input.folder.empty() || !std::filesystem::exists(file)
             ? Table{}
             : microbenchmark_table(read_microbenchmarks({file}));
}

}  // namespace cbc3d::reports

// The microbenchmarks beside a run.
#pragma once

#include <filesystem>
#include <vector>

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// The microbenchmarks of Google Benchmark's JSON files (--benchmark_out) in one object, {"benchmarks":
/// [...]}. Throws InputError naming file, key and remedy for another file.
Json read_microbenchmarks(const std::vector<std::filesystem::path>& files);

/// Table `microbenchmarks`; the counter of_bandwidth, a kernel's share of the machine's memory bandwidth, in
/// percent.
Table microbenchmark_table(const Json& microbenchmarks);

/// The table of microbenchmarks.json in the run's folder; without rows when there is no such file.
Table microbenchmarks_of_run(const TableInput& input);

}  // namespace cbc3d::reports

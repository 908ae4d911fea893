// What a sweep over threads tells: medians and spreads of times, speed-up and efficiency, stage by stage.
#pragma once

#include <string>
#include <vector>

#include "reports/charts/figures.hpp"
#include "reports/results/result.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// The samples of one time, in the order in which they were taken.
struct Samples {
  std::vector<double> seconds;
  std::vector<bool> outlier;  ///< by statistics.hpp's outliers(); they count all the same
  double median_s = 0;
  double spread_s = 0;  ///< standard deviation by the median absolute deviation
  double error_s = 0;   ///< standard error of the median
};

/// A quotient and its standard error.
struct Ratio {
  double value = 1;
  double error = 0;
};

/// One mesher on one case with one thread count.
struct SweepPoint {
  std::string case_name, mesher;
  int threads = 1;
  Samples total;
  Samples with_files;                                   ///< reading and writing included
  std::vector<std::pair<std::string, Samples>> stages;  ///< those that every sample has
  std::vector<Ratio> stage_speed_ups;  ///< of the stages, in their order; empty without a speed-up
  bool has_speed_up = false;           ///< there are samples with fewer threads to compare with
  int base_threads = 1;                ///< the fewest threads, which the speed-up is over
  Ratio speed_up;
  Ratio efficiency;     ///< speed-up over threads / base_threads
  std::string failure;  ///< of a sample that is not ok; empty: none
};

/// One point for every case, mesher and thread count. Errors of quotients: relative errors added in
/// quadrature.
std::vector<SweepPoint> sweep_points(const std::vector<Json>& results);

/// All points with all samples.
Json to_json(const std::vector<SweepPoint>& points);

/// Tables `sweep` (median, spread, speed-up, efficiency, outliers), `sweep_stages`, and `sweep_parallel`
/// (parallel_table.hpp) where one thread was measured and more were.
std::vector<Table> sweep_tables(const std::vector<SweepPoint>& points);

/// Per case: the times and the speed-ups over the threads, and for every mesher of several thread counts the
/// stages.
std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points);

/// The microbenchmarks of Google Benchmark's JSON files (--benchmark_out) in one object, {"benchmarks":
/// [...]}. Throws InputError naming file, key and remedy for another file.
Json read_microbenchmarks(const std::vector<std::filesystem::path>& files);

/// A table of them; the counter of_bandwidth, a kernel's share of the machine's memory bandwidth, in percent.
Table microbenchmark_table(const Json& microbenchmarks);

}  // namespace cbc3d::reports

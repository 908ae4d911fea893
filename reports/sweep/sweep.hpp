// A sweep over threads: medians and spreads of times, speed-up and efficiency, stage by stage.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "reports/results/job_result.hpp"

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
  Samples total = {};
  Samples with_files = {};                                   ///< reading and writing included
  std::vector<std::pair<std::string, Samples>> stages = {};  ///< those that every sample has
  std::vector<Ratio> stage_speed_ups = {};  ///< of the stages, in their order; empty without a speed-up
  bool has_speed_up = false;                ///< there are samples with fewer threads to compare with
  int base_threads = 1;                     ///< the fewest threads, which the speed-up is over
  Ratio speed_up = {};
  Ratio efficiency = {};     ///< speed-up over threads / base_threads
  std::string failure = {};  ///< of a sample that is not ok; empty: none
};

/// One point for every case, mesher and thread count. Errors of quotients: relative errors added in
/// quadrature.
std::vector<SweepPoint> sweep_points(const std::vector<JobResult>& results);

/// All points with all samples.
Json to_json(const std::vector<SweepPoint>& points);

/// The points of a run whose folder has a sweep.json; none of another run.
std::vector<SweepPoint> points_of_sweep(const std::filesystem::path& folder,
                                        const std::vector<JobResult>& results);

}  // namespace cbc3d::reports

// Times of a gate by a test in place of a fixed tolerance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/gate/check.hpp"
#include "reports/gate/gate_job.hpp"

namespace cbc3d::reports {

struct TimeTest {
  /// What is compared: "time_ratio", which another machine does not change, or "time_s.cpu", which is quieter
  /// where the reference work, a tenth of a second, is disturbed more than the jobs.
  std::string figure = "time_ratio";
  double level = 0.01;              ///< of all tests of a gate together, by Holm's correction
  double least_change_percent = 5;  ///< of the median: what is less does not fall, however certain it is
};

/// A check for every job that can be tested, by its name: it fell where the rank test tells that its repeats'
/// figure is larger than the baseline's samples, and the medians differ by the least change. Jobs
/// without enough repeats on both sides have no check, but a line in `notes` that says why.
std::map<std::string, Check> time_checks(const std::vector<GateJob>& jobs, const Json& baseline,
                                         const TimeTest& test, std::vector<std::string>& notes);

}  // namespace cbc3d::reports

// The figures of a job that the gate compares, from the lines of its repeats.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// In which direction a figure is worse.
enum class Worse { higher, lower, other };

/// A figure of the gate.
struct GateFigure {
  const char* name;  ///< as in a baseline: its path in a result line, or "time_ratio"
  const char* words;
  const char* unit;
  Worse worse;
  const char* tolerance;  ///< its class of tolerance; "exact": none
};

const std::vector<GateFigure>& gate_figures();

/// A job's repeats as one.
struct GateJob {
  std::string name;  ///< "liver, cgal, 1 thread"
  Json identity;     ///< case, mesher, threads, parameters
  bool deterministic = true;
  std::string failure;           ///< status and reason of a repeat that is not ok; empty: none
  std::string first_difference;  ///< of repeats that should be the same; empty: none
  std::vector<long> missing_labels;
  std::map<std::string, double> figures;  ///< by GateFigure::name, those that the job has
};

/// Jobs in the order of their first lines.
std::vector<GateJob> gate_jobs(const std::vector<Json>& results);

/// "liver, cgal, 1 thread" of a result line or a baseline's job.
std::string gate_job_name(const Json& job);

}  // namespace cbc3d::reports

// The figures of a job that the gate compares, from its repeats.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// A job's repeats as one.
struct GateJob {
  std::string name;  ///< "liver, cgal, 1 thread"
  Json identity;     ///< case, mesher, threads, parameters
  bool deterministic = true;
  std::string failure;           ///< status and reason of a repeat that is not ok; empty: none
  std::string first_difference;  ///< of repeats that should be the same; empty: none
  std::vector<long> missing_labels;
  metrics::Figures figures;
  /// Of every good repeat that has one, in their order: "time_ratio" and "time_s.cpu".
  std::map<std::string, std::vector<double>> time_samples;
  Json parameters_in_force;  ///< by what the mesher says, with its defaults; empty: it says nothing
};

/// Jobs in the order of their first lines.
std::vector<GateJob> gate_jobs(const std::vector<JobResult>& results);

/// "liver, cgal, 1 thread".
std::string gate_job_name(const std::string& case_name, const std::string& mesher, int threads);

/// The metrics that the catalog gates, in its order.
std::vector<metrics::MetricId> gated_metrics();

/// The gated metric with this key; none where there is none.
std::optional<metrics::MetricId> find_gated_metric(const std::string& key);

}  // namespace cbc3d::reports

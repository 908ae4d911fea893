#include "reports/gate/gate_job.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "reports/results/columns.hpp"
#include "reports/results/format_number.hpp"
#include "reports/results/joint_figures.hpp"
#include "reports/results/run_values.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::MetricId;

metrics::Figures figures_of(const Runs& runs) {
  std::vector<const metrics::Figures*> repeats;
  repeats.reserve(runs.size());
  for (const JobResult* run : runs) {
    repeats.push_back(&run->figures);
  }
  return joint_figures(repeats);
}

std::string first_failure(const Runs& runs) {
  const auto bad = std::find_if(runs.begin(), runs.end(), [](const JobResult* run) { return !run->is_ok(); });
  return bad == runs.end() ? "" : failure_of(**bad);
}

/// "counts is 20 in repeat 0 and 21 in repeat 1".
std::string difference(const std::string& what, const JobResult& a, const std::string& value_a,
                       const JobResult& b, const std::string& value_b) {
  return what + " is " + value_a + " in repeat " + std::to_string(a.repeat) + " and " + value_b +
         " in repeat " + std::to_string(b.repeat);
}

/// Repeats of a deterministic mesher give the same mesh.
std::string first_difference(const Runs& runs) {
  const JobResult& first = *runs.front();
  for (const JobResult* run : runs) {
    if (run->mesh_sha256 != first.mesh_sha256) {
      return difference("mesh_sha256", first, '"' + first.mesh_sha256 + '"', *run,
                        '"' + run->mesh_sha256 + '"');
    }
    for (const MetricId id : gated_metrics()) {
      if (metric(id).key.starts_with("counts.") && run->figures[id] != first.figures[id]) {
        const auto text = [&](const JobResult& job) {
          return job.figures[id] ? format_number(*job.figures[id], 0) : "null";
        };
        return difference(std::string(metric(id).key), first, text(first), *run, text(*run));
      }
    }
  }
  return "";
}

std::vector<long> missing_labels(const Runs& runs) {
  std::set<long> labels;
  for (const JobResult* run : runs) {
    labels.insert(run->missing_labels.begin(), run->missing_labels.end());
  }
  return {labels.begin(), labels.end()};
}

GateJob joint(const Runs& runs) {
  const JobResult& first = *runs.front();
  GateJob job;
  job.name = gate_job_name(row_name(first), first.mesher, first.threads);
  job.identity = {{"case", row_name(first)},
                  {"mesher", first.mesher},
                  {"threads", first.threads},
                  {"parameters", first.parameters}};
  job.deterministic = first.mesher_is_deterministic;
  job.failure = first_failure(runs);
  job.first_difference = job.deterministic && job.failure.empty() ? first_difference(runs) : "";
  job.missing_labels = missing_labels(runs);
  job.figures = figures_of(runs);
  job.time_samples = {{"time_ratio", values_of(runs, shown_figure(metrics::metric_id("time_ratio")))},
                      {"time_s.cpu", values_of(runs, shown_figure(metrics::metric_id("time_s.cpu")))}};
  job.parameters_in_force = first.reported_parameters;
  return job;
}

}  // namespace

std::string gate_job_name(const std::string& case_name, const std::string& mesher, int threads) {
  return case_name + ", " + mesher + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

std::vector<MetricId> gated_metrics() {
  std::vector<MetricId> ids;
  for (const MetricId id : metrics::all_metrics()) {
    if (metric(id).gate != nullptr) {
      ids.push_back(id);
    }
  }
  return ids;
}

std::optional<MetricId> find_gated_metric(const std::string& key) {
  for (const MetricId id : gated_metrics()) {
    if (metric(id).key == key) {
      return id;
    }
  }
  return std::nullopt;
}

std::vector<GateJob> gate_jobs(const std::vector<JobResult>& results) {
  std::vector<std::string> order;
  std::map<std::string, Runs> runs;
  for (const JobResult& result : results) {
    const std::string name = gate_job_name(row_name(result), result.mesher, result.threads);
    if (!runs.contains(name)) {
      order.push_back(name);
    }
    runs[name].push_back(&result);
  }
  std::vector<GateJob> jobs;
  jobs.reserve(order.size());
  for (const std::string& name : order) {
    jobs.push_back(joint(runs.at(name)));
  }
  return jobs;
}

}  // namespace cbc3d::reports

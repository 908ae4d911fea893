#include "reports/gate/gate.hpp"

#include <algorithm>
#include <map>

#include "reports/gate/gate_job.hpp"
#include "reports/gate/parameter_change.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::Metric;
using metrics::MetricId;

Check check_labels(const GateJob& job, const Json& entry) {
  std::string lost;
  for (const long label : job.missing_labels) {
    const Json& known = entry["missing_labels"];
    if (std::find(known.begin(), known.end(), Json(label)) == known.end()) {
      lost += (lost.empty() ? "" : ", ") + std::to_string(label);
    }
  }
  if (lost.empty()) {
    return {job.name, "labels", false, false, 0, "every label that was in the mesh is"};
  }
  return fallen(job.name, "labels", "label " + lost + " was in the mesh and is not any more");
}

/// Figures that a baseline older than they are does not have are no fault of the job.
void note_new_figures(const GateJob& job, const Json& figures, Verdict& verdict) {
  std::string keys;
  for (const MetricId id : gated_metrics()) {
    const std::string key(metric(id).key);
    if (job.figures[id] && !figures.contains(key)) {
      keys += (keys.empty() ? "" : ", ") + key;
    }
  }
  if (!keys.empty()) {
    verdict.notes.push_back(job.name + ": not compared, for the baseline lacks " + keys +
                            "; --update takes them in");
  }
}

/// Compares the runs' jobs with a baseline's, one by one.
class Comparer {
 public:
  Comparer(const std::vector<GateJob>& jobs, const Json& baseline, const CompareOptions& options)
      : jobs_(jobs), baseline_(baseline), options_(options) {
    if (options.time_test) {
      times_ = time_checks(jobs, baseline, *options.time_test, verdict_.notes);
      for (const auto& [name, check] : times_) {
        if (!check.fell && !check.better) {
          verdict_.notes.push_back(name + ": " + check.text);
        }
      }
    }
  }

  Verdict verdict() {
    for (const Json& entry : baseline_["jobs"]) {
      compare_entry(entry);
    }
    for (const GateJob& job : jobs_) {
      compare_new(job);
    }
    apply_known_failures();
    std::stable_sort(verdict_.checks.begin(), verdict_.checks.end(), [](const Check& a, const Check& b) {
      return a.fell != b.fell ? a.fell : a.fell && a.severity > b.severity;
    });
    return std::move(verdict_);
  }

 private:
  void add(Check check) { verdict_.checks.push_back(std::move(check)); }

  void compare_entry(const Json& entry) {
    const std::string name = name_of_entry(entry);
    const auto job = std::find_if(jobs_.begin(), jobs_.end(),
                                  [&](const GateJob& candidate) { return candidate.name == name; });
    if (job != jobs_.end()) {
      compare_job(*job, entry);
    } else if (options_.is_partial) {
      verdict_.notes.push_back(name + ": not run");
    } else {
      add(fallen(name, "status", "is in the baseline and was not run"));
    }
  }

  void compare_new(const GateJob& job) {
    const Json& entries = baseline_["jobs"];
    if (std::any_of(entries.begin(), entries.end(),
                    [&](const Json& entry) { return name_of_entry(entry) == job.name; })) {
      return;
    }
    if (is_known_failure(baseline_, job.name, "status")) {
      add(job.failure.empty() ? Check{job.name, "status", false, false, 0, "ok"}
                              : fallen(job.name, "status", "is " + job.failure));
    } else {
      verdict_.notes.push_back(job.name + ": not in the baseline; --update takes it in");
    }
  }

  void compare_job(const GateJob& job, const Json& entry) {
    if (!job.failure.empty()) {
      add(fallen(job.name, "status", "was ok, is " + job.failure));
      return;
    }
    add({job.name, "status", false, false, 0, "ok"});
    if (job.identity["parameters"] != entry["parameters"]) {
      add(fallen(job.name, "parameters",
                 changes_of(entry["parameters"], job.identity["parameters"]) +
                     "; run as the baseline was, or --update. " + cost(job, entry)));
      return;
    }
    note_parameters_in_force(job, entry);
    compare_repeats(job);
    add(check_labels(job, entry));
    note_new_figures(job, entry["figures"], verdict_);
    for (Check& check : figure_checks(job, entry)) {
      add(std::move(check));
    }
  }

  void compare_repeats(const GateJob& job) {
    if (job.deterministic) {
      add(job.first_difference.empty() ? Check{job.name, "repeats", false, false, 0, "repeats are the same"}
                                       : fallen(job.name, "repeats", job.first_difference));
    }
  }

  [[nodiscard]] std::vector<Check> figure_checks(const GateJob& job, const Json& entry) const {
    std::vector<Check> checks;
    for (const MetricId id : gated_metrics()) {
      if (entry["figures"].contains(metric(id).key)) {
        checks.push_back(check_one(job, id, entry));
      }
    }
    return checks;
  }

  [[nodiscard]] Check check_one(const GateJob& job, MetricId id, const Json& entry) const {
    const Metric& row = metric(id);
    const std::string key(row.key);
    const auto tested = times_.find(job.name);
    if (row.gate == &metrics::kTime && tested != times_.end()) {
      return tested->second;
    }
    const double was = entry["figures"][key].get<double>();
    const auto& is = job.figures[id];
    return is ? check_figure(job.name, row, was, *is,
                             allowed_change(row, was, job.deterministic, baseline_["tolerances"]))
              : fallen(job.name, key,
                       std::string(words(row)) + " was " + with_unit(was, row) + ", is not there");
  }

  [[nodiscard]] std::string cost(const GateJob& job, const Json& entry) const {
    return cost_of_change(figure_checks(job, entry));
  }

  /// A mesher's defaults may change without anybody having given a parameter.
  void note_parameters_in_force(const GateJob& job, const Json& entry) {
    const Json were = figure(entry, {"parameters_in_force"});
    if (were.is_object() && !were.empty() && were != job.parameters_in_force) {
      verdict_.notes.push_back(job.name + ": by the mesher's defaults " +
                               changes_of(were, job.parameters_in_force) + ". " + cost(job, entry));
    }
  }

  void apply_known_failures() {
    for (const Json& known : known_failures_of(baseline_)) {
      bool is_found = false;
      for (Check& check : verdict_.checks) {
        if (known["job"] == check.job && known["figure"] == check.figure) {
          is_found = true;
          mark(check, known["reason"].get<std::string>());
        }
      }
      if (!is_found) {
        verdict_.notes.push_back(known["job"].get<std::string>() + ": its known failure of " +
                                 known["figure"].get<std::string>() + " was not compared");
      }
    }
  }

  static void mark(Check& check, const std::string& reason) {
    check.known = check.fell ? Known::fails : Known::passes;
    check.text += check.fell ? " (known: " + reason + ")"
                             : " (it was known to fail: " + reason + "; take it off \"known_failures\")";
    check.fell = false;
  }

  const std::vector<GateJob>& jobs_;
  const Json& baseline_;
  const CompareOptions& options_;
  std::map<std::string, Check> times_;  ///< by the test, of the jobs that it can tell of
  Verdict verdict_;
};

}  // namespace

std::size_t Verdict::fallen() const {
  return static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.fell; }));
}

std::size_t Verdict::count(Known known) const {
  return static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [&](const Check& check) { return check.known == known; }));
}

Verdict compare(const std::vector<JobResult>& results, const Json& baseline, const CompareOptions& options) {
  const std::vector<GateJob> jobs = gate_jobs(results);
  return Comparer(jobs, baseline, options).verdict();
}

}  // namespace cbc3d::reports

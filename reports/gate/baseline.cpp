#include "reports/gate/baseline.hpp"

#include <algorithm>
#include <fstream>
#include <map>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "reports/gate/gate_job.hpp"
#include "reports/run/provenance.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

using metrics::metric;
using metrics::MetricId;

constexpr const char* kFormat = "cbc3d-baseline-1";

/// The classes of tolerance of the catalog, each once. What is exact needs none.
std::vector<const metrics::Tolerance*> tolerance_classes() {
  std::vector<const metrics::Tolerance*> classes;
  for (const MetricId id : gated_metrics()) {
    const metrics::Tolerance* gate = metric(id).gate;
    if (gate != &metrics::kExact && std::find(classes.begin(), classes.end(), gate) == classes.end()) {
      classes.push_back(gate);
    }
  }
  return classes;
}

Json default_tolerances() {
  Json tolerances;
  for (const metrics::Tolerance* c : tolerance_classes()) {
    tolerances[std::string(c->name)] = {{"relative", c->relative}, {"absolute", c->absolute}};
  }
  return tolerances;
}

[[noreturn]] void fail(const fs::path& file, const std::string& key, const std::string& finding) {
  throw InputError("baseline '" + file.string() + "': \"" + key + "\" " + finding);
}

void check_tolerances(const Json& tolerances, const fs::path& file) {
  for (const auto& [name, value] : tolerances.items()) {
    const std::string key = "tolerances." + name;
    if (!default_tolerances().contains(name)) {
      fail(file, key, "is no class of tolerance; there are " + default_tolerances().dump());
    }
    for (const char* kind : {"relative", "absolute"}) {
      const Json number = figure(value, {kind});
      if (!number.is_number() || number.get<double>() < 0) {
        fail(file, key + "." + kind, "is " + number.dump() + "; give a number from 0 on");
      }
    }
  }
}

bool is_numbers(const Json& list) {
  return list.is_array() &&
         std::all_of(list.begin(), list.end(), [](const Json& number) { return number.is_number(); });
}

/// What a baseline older than them does not have.
void check_newer_keys(const Json& job, const std::string& key, const fs::path& file) {
  for (const char* name : {"time_ratio", "time_s.cpu"}) {
    const Json samples = figure(job, {"samples", name});
    if (!samples.is_null() && !is_numbers(samples)) {
      fail(file, key + ".samples." + name, "is " + samples.dump() + "; give a list of numbers");
    }
  }
  const Json in_force = figure(job, {"parameters_in_force"});
  if (!in_force.is_null() && !in_force.is_object()) {
    fail(file, key + ".parameters_in_force", "is " + in_force.dump() + "; give an object of texts");
  }
}

void check_job(const Json& job, const std::string& key, const fs::path& file) {
  if (!job.is_object()) {
    fail(file, key, "is " + job.dump() + "; give an object, or write the baseline anew with --update");
  }
  const auto require = [&](const char* name, bool good, const char* remedy) {
    if (!good) {
      fail(file, key + "." + name, "is " + figure(job, {name}).dump() + "; give " + remedy);
    }
  };
  require("case", figure(job, {"case"}).is_string(), "the name of a case");
  require("mesher", figure(job, {"mesher"}).is_string(), "the name of a mesher");
  require("threads", figure(job, {"threads"}).is_number_integer(), "a thread count");
  require("parameters", figure(job, {"parameters"}).is_object(), "an object of texts");
  require("deterministic", figure(job, {"deterministic"}).is_boolean(), "true or false");
  const Json labels = figure(job, {"missing_labels"});
  require("missing_labels",
          labels.is_array() &&
              std::all_of(labels.begin(), labels.end(), [](const Json& l) { return l.is_number_integer(); }),
          "a list of labels");
  require("figures", figure(job, {"figures"}).is_object(), "an object of numbers");
  for (const auto& [name, value] : job["figures"].items()) {
    const bool is_known = find_gated_metric(name).has_value();
    if (!is_known || !value.is_number()) {
      fail(file, key + ".figures." + name,
           is_known ? "is " + value.dump() + "; give a number" : "is no figure of the gate; remove it");
    }
  }
  check_newer_keys(job, key, file);
}

void check_known_failures(const Json& baseline, const fs::path& file) {
  const Json list = known_failures_of(baseline);
  if (!list.is_array()) {
    fail(file, "known_failures",
         "is " + list.dump() + "; give a list of objects with job, figure and reason");
  }
  for (std::size_t n = 0; n < list.size(); ++n) {
    for (const char* name : {"job", "figure", "reason"}) {
      const Json text = figure(list[n], {name});
      if (!text.is_string() || text == "") {
        fail(file, "known_failures[" + std::to_string(n) + "]." + name,
             "is " + text.dump() + "; give a text, the job and the figure as the gate prints them");
      }
    }
  }
}

Json baseline_job(const GateJob& job) {
  std::map<std::string, double> figures;
  for (const MetricId id : gated_metrics()) {
    if (const auto& figure = job.figures[id]) {
      figures[std::string(metric(id).key)] = *figure;
    }
  }
  Json entry = job.identity;
  entry["parameters_in_force"] = job.parameters_in_force;
  entry["deterministic"] = job.deterministic;
  entry["missing_labels"] = job.missing_labels;
  entry["figures"] = figures;
  entry["samples"] = job.time_samples;
  return entry;
}

/// The entry of a job; null where the baseline has none.
Json entry_of(const Json& baseline, const std::string& job) {
  const Json jobs = figure(baseline, {"jobs"});
  const auto found =
      std::find_if(jobs.begin(), jobs.end(), [&](const Json& entry) { return name_of_entry(entry) == job; });
  return found == jobs.end() ? Json() : *found;
}

/// The new entry of a job, in which known failures keep what they were; null: the job has none.
Json next_entry(const GateJob& job, const Json& former) {
  Json before = entry_of(former, job.name);
  const bool is_bad = !job.failure.empty() || !job.first_difference.empty();
  if (is_bad && is_known_failure(former, job.name, job.failure.empty() ? "repeats" : "status")) {
    return before;
  }
  if (is_bad) {
    throw InputError(job.name + ": " + (job.failure.empty() ? job.first_difference : job.failure) +
                     "; a baseline is made of good jobs only, and of known failures");
  }
  Json entry = baseline_job(job);
  const Json figures = before.is_object() ? before["figures"] : Json::object();
  for (const auto& [key, value] : figures.items()) {
    if (is_known_failure(former, job.name, key)) {
      entry["figures"][key] = value;
    }
  }
  return entry;
}

Json history_entry(const std::string& reason, const std::vector<GateJob>& jobs, bool is_partial) {
  const Json origin = provenance();
  Json entry{{"utc", utc_now()},
             {"git_commit", origin["git_commit"]},
             {"git_dirty", origin["git_dirty"]},
             {"reason", reason}};
  if (is_partial) {
    entry["jobs"] = Json::array();
    for (const GateJob& job : jobs) {
      entry["jobs"].push_back(job.name);
    }
  }
  return entry;
}

/// Puts an entry in the place of the one of the same job, or at the end.
void put(Json& entries, const Json& entry) {
  for (Json& there : entries) {
    if (name_of_entry(there) == name_of_entry(entry)) {
      there = entry;
      return;
    }
  }
  entries.push_back(entry);
}

}  // namespace

std::string name_of_entry(const Json& entry) {
  return gate_job_name(entry["case"].get<std::string>(), entry["mesher"].get<std::string>(),
                       entry["threads"].get<int>());
}

Json known_failures_of(const Json& baseline) {
  Json list = figure(baseline, {"known_failures"});
  return list.is_null() ? Json::array() : list;
}

bool is_known_failure(const Json& baseline, const std::string& job, const std::string& figure) {
  const Json list = known_failures_of(baseline);
  return std::any_of(list.begin(), list.end(),
                     [&](const Json& known) { return known["job"] == job && known["figure"] == figure; });
}

Json read_baseline(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError("cannot read the baseline '" + file.string() + "'; write one with --update \"REASON\"");
  }
  Json baseline = parse_json<Json>(stream, "baseline '" + file.string() + "'");
  if (figure(baseline, {"format"}) != kFormat) {
    fail(file, "format",
         "is " + figure(baseline, {"format"}).dump() + ", not \"" + kFormat +
             "\"; write the baseline anew with --update \"REASON\"");
  }
  if (!figure(baseline, {"tolerances"}).is_object()) {
    fail(file, "tolerances", "is missing or no object; " + default_tolerances().dump() + " are usual");
  }
  check_tolerances(baseline["tolerances"], file);
  Json tolerances = default_tolerances();
  tolerances.update(baseline["tolerances"]);
  baseline["tolerances"] = std::move(tolerances);
  if (!figure(baseline, {"jobs"}).is_array() || baseline["jobs"].empty()) {
    fail(file, "jobs", "is missing, no list or empty; write the baseline anew with --update \"REASON\"");
  }
  for (std::size_t n = 0; n < baseline["jobs"].size(); ++n) {
    check_job(baseline["jobs"][n], "jobs[" + std::to_string(n) + "]", file);
  }
  check_known_failures(baseline, file);
  return baseline;
}

Json make_baseline(const std::vector<JobResult>& results, const Json& former, const std::string& reason,
                   bool is_partial) {
  const std::vector<GateJob> jobs = gate_jobs(results);
  Json baseline;
  baseline["format"] = kFormat;
  baseline["history"] = figure(former, {"history"}).is_array() ? former["history"] : Json::array();
  baseline["history"].push_back(history_entry(reason, jobs, is_partial));
  baseline["tolerances"] = former.is_object() ? former["tolerances"] : default_tolerances();
  if (!known_failures_of(former).empty()) {
    baseline["known_failures"] = known_failures_of(former);
  }
  const bool has_former = is_partial && former.is_object();
  baseline["jobs"] = has_former ? former["jobs"] : Json::array();
  for (const GateJob& job : jobs) {
    if (const Json entry = next_entry(job, former); !entry.is_null()) {
      put(baseline["jobs"], entry);
    }
  }
  return baseline;
}

}  // namespace cbc3d::reports

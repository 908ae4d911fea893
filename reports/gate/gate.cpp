#include "reports/gate/gate.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "reports/gate/gate_job.hpp"
#include "reports/results/format_number.hpp"
#include "reports/run/provenance.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

using metrics::metric;
using metrics::Metric;
using metrics::MetricId;

constexpr const char* kFormat = "cbc3d-baseline-1";
constexpr double kUnbounded = 1e9;  ///< severity of what has no tolerance

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
}

Json baseline_job(const GateJob& job) {
  std::map<std::string, double> figures;
  for (const MetricId id : gated_metrics()) {
    if (const auto& figure = job.figures[id]) {
      figures[std::string(metric(id).key)] = *figure;
    }
  }
  Json entry = job.identity;
  entry["deterministic"] = job.deterministic;
  entry["missing_labels"] = job.missing_labels;
  entry["figures"] = figures;
  return entry;
}

/// "1.5000 mm": a value of a result line in the unit in which it is shown.
std::string with_unit(double value, const Metric& metric) {
  const double shown = metric.scale * value;
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  const int decimals = metric.scale != 1 ? 1 : whole ? 0 : 4;
  return format_number(shown, decimals) + (metric.unit.empty() ? "" : " " + std::string(metric.unit));
}

/// Compares one figure. `allowed`: the change that is let pass.
Check check_figure(const std::string& job, const Metric& metric, double was, double is, double allowed) {
  const double change = is - was;
  const double worse = metric.worse == metrics::Worse::lower    ? -change
                       : metric.worse == metrics::Worse::higher ? change
                                                                : std::abs(change);
  Check check{job, std::string(metric.key), worse > allowed, -worse > allowed, 0, ""};
  check.severity = allowed > 0 ? worse / allowed : kUnbounded + worse;
  const std::string sign = change > 0 ? "+" : "";
  check.text = std::string(words(metric)) + " was " + with_unit(was, metric) + ", is " +
               with_unit(is, metric) + " (" + sign + with_unit(change, metric) +
               (was != 0 ? ", " + sign + format_number(100 * change / std::abs(was), 1) + " %" : "") +
               "; allowed " + with_unit(allowed, metric) + ")";
  return check;
}

Check fallen(const std::string& job, const std::string& figure, const std::string& text) {
  return {job, figure, true, false, 2 * kUnbounded, text};
}

double allowed_change(const Metric& metric, double was, bool deterministic, const Json& tolerances) {
  if (metric.gate == &metrics::kExact || (metric.gate == &metrics::kCounts && deterministic)) {
    return 0;
  }
  const Json& tolerance = tolerances.at(std::string(metric.gate->name));
  return std::max(tolerance["relative"].get<double>() * std::abs(was), tolerance["absolute"].get<double>());
}

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

void compare_figures(const GateJob& job, const Json& figures, const Json& tolerances, Verdict& verdict) {
  note_new_figures(job, figures, verdict);
  for (const MetricId id : gated_metrics()) {
    const Metric& row = metric(id);
    const std::string key(row.key);
    if (!figures.contains(key)) {
      continue;
    }
    const double was = figures[key].get<double>();
    const auto& is = job.figures[id];
    verdict.checks.push_back(
        is ? check_figure(job.name, row, was, *is, allowed_change(row, was, job.deterministic, tolerances))
           : fallen(job.name, key,
                    std::string(words(row)) + " was " + with_unit(was, row) + ", is not there"));
  }
}

void compare_job(const GateJob& job, const Json& entry, const Json& tolerances, Verdict& verdict) {
  if (!job.failure.empty()) {
    verdict.checks.push_back(fallen(job.name, "status", "was ok, is " + job.failure));
    return;
  }
  if (job.identity["parameters"] != entry["parameters"]) {
    verdict.checks.push_back(fallen(job.name, "parameters",
                                    "were " + entry["parameters"].dump() + ", are " +
                                        job.identity["parameters"].dump() +
                                        "; run as the baseline was, or --update"));
    return;
  }
  verdict.checks.push_back({job.name, "status", false, false, 0, "ok"});
  if (job.deterministic) {
    verdict.checks.push_back(job.first_difference.empty()
                                 ? Check{job.name, "repeats", false, false, 0, "repeats are the same"}
                                 : fallen(job.name, "repeats", job.first_difference));
  }
  verdict.checks.push_back(check_labels(job, entry));
  compare_figures(job, entry["figures"], tolerances, verdict);
}

/// As GateJob::name.
std::string name_of(const Json& entry) {
  return gate_job_name(entry["case"].get<std::string>(), entry["mesher"].get<std::string>(),
                       entry["threads"].get<int>());
}

}  // namespace

std::size_t Verdict::fallen() const {
  return static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return check.fell; }));
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
  return baseline;
}

Json make_baseline(const std::vector<JobResult>& results, const Json& former, const std::string& reason) {
  Json baseline;
  baseline["format"] = kFormat;
  baseline["history"] = figure(former, {"history"}).is_array() ? former["history"] : Json::array();
  const Json origin = provenance();
  baseline["history"].push_back({{"utc", utc_now()},
                                 {"git_commit", origin["git_commit"]},
                                 {"git_dirty", origin["git_dirty"]},
                                 {"reason", reason}});
  baseline["tolerances"] = former.is_object() ? former["tolerances"] : default_tolerances();
  baseline["jobs"] = Json::array();
  for (const GateJob& job : gate_jobs(results)) {
    if (!job.failure.empty() || !job.first_difference.empty()) {
      throw InputError(job.name + ": " + (job.failure.empty() ? job.first_difference : job.failure) +
                       "; a baseline is made of good jobs only");
    }
    baseline["jobs"].push_back(baseline_job(job));
  }
  return baseline;
}

Verdict compare(const std::vector<JobResult>& results, const Json& baseline) {
  const std::vector<GateJob> jobs = gate_jobs(results);
  Verdict verdict;
  for (const Json& entry : baseline["jobs"]) {
    const std::string name = name_of(entry);
    const auto job = std::find_if(jobs.begin(), jobs.end(),
                                  [&](const GateJob& candidate) { return candidate.name == name; });
    if (job == jobs.end()) {
      verdict.checks.push_back(fallen(name, "status", "is in the baseline and was not run"));
    } else {
      compare_job(*job, entry, baseline["tolerances"], verdict);
    }
  }
  for (const GateJob& job : jobs) {
    const Json& entries = baseline["jobs"];
    if (std::none_of(entries.begin(), entries.end(),
                     [&](const Json& entry) { return name_of(entry) == job.name; })) {
      verdict.notes.push_back(job.name + ": not in the baseline; --update takes it in");
    }
  }
  std::stable_sort(verdict.checks.begin(), verdict.checks.end(), [](const Check& a, const Check& b) {
    return a.fell != b.fell ? a.fell : a.fell && a.severity > b.severity;
  });
  return verdict;
}

}  // namespace cbc3d::reports

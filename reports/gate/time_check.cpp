#include "reports/gate/time_check.hpp"

#include <algorithm>
#include <cstdio>

#include "reports/gate/baseline.hpp"
#include "reports/results/format_number.hpp"
#include "reports/statistics/comparison.hpp"
#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {
namespace {

struct Tested {
  const GateJob* job;
  SamplePair samples;
};

std::vector<double> samples_of(const Json& entry, const std::string& key) {
  const Json list = figure(entry, {"samples", key});
  return list.is_array() ? list.get<std::vector<double>>() : std::vector<double>();
}

/// The good jobs with times on both sides.
std::vector<Tested> tested_jobs(const std::vector<GateJob>& jobs, const Json& baseline,
                                const std::string& key, std::vector<std::string>& notes) {
  std::vector<Tested> list;
  for (const Json& entry : baseline["jobs"]) {
    const std::string name = name_of_entry(entry);
    const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const GateJob& j) { return j.name == name; });
    if (job == jobs.end() || !job->failure.empty() || job->identity["parameters"] != entry["parameters"]) {
      continue;
    }
    SamplePair samples{job->time_samples.at(key), samples_of(entry, key)};
    if (samples.sample.empty() || samples.reference.empty()) {
      notes.push_back(name + ": time is held to its fixed tolerance, for the " +
                      (samples.sample.empty() ? "run has no times" : "baseline has no samples of it") +
                      (samples.reference.empty() ? "; --update takes them in" : ""));
    } else {
      list.push_back({&*job, std::move(samples)});
    }
  }
  return list;
}

const metrics::Metric& metric_of(const std::string& key) {
  return metrics::metric(key == "time_s.cpu" ? metrics::metric_id("time_s.cpu")
                                             : metrics::metric_id("time_ratio"));
}

std::string percent(double ratio) {
  const double change = 100 * (ratio - 1);
  return (change >= 0 ? "+" : "") + format_number(change, 1);
}

std::string p_text(double p) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", p);
  return text;
}

/// "CPU time over the reference work's: median was 50, is 54 (+8.0 % [+6.1, +9.8]; p 0.0001, A 1.00; ...)".
std::string text_of(const Comparison& found, const SamplePair& samples, const TimeTest& test) {
  const metrics::Metric& metric = metric_of(test.figure);
  const auto& interval = found.ratio_interval;
  return std::string(metric.name) + ": median was " + format_number(median(samples.reference), 2) + ", is " +
         format_number(median(samples.sample), 2) + " (" + percent(found.ratio.value_or(1)) + " %" +
         (interval ? " [" + percent(interval->low) + ", " + percent(interval->high) + "]" : "") + "; p " +
         p_text(found.adjusted_p) + ", A " + format_number(found.effect, 2) + ", " +
         std::to_string(samples.sample.size()) + " repeats against " +
         std::to_string(samples.reference.size()) + "; falls from +" +
         format_number(test.least_change_percent, 1) + " % on with p at most " + p_text(test.level) + ")";
}

Check check_of(const Tested& tested, const Comparison& found, const TimeTest& test) {
  const double least = test.least_change_percent / 100, change = found.ratio.value_or(1) - 1;
  Check check;
  check.job = tested.job->name;
  check.figure = "time_ratio";  // the time that a baseline gates
  check.fell = found.finding == Finding::larger && change >= least;
  check.better = found.finding == Finding::smaller && -change >= least;
  check.severity = least > 0 ? change / least : change;
  check.text = text_of(found, tested.samples, test);
  return check;
}

}  // namespace

std::map<std::string, Check> time_checks(const std::vector<GateJob>& jobs, const Json& baseline,
                                         const TimeTest& test, std::vector<std::string>& notes) {
  const std::vector<Tested> list = tested_jobs(jobs, baseline, test.figure, notes);
  std::vector<SamplePair> pairs;
  pairs.reserve(list.size());
  for (const Tested& tested : list) {
    pairs.push_back(tested.samples);
  }
  const std::vector<Comparison> found = compare_samples(pairs, test.level);
  std::map<std::string, Check> checks;
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (found[n].finding == Finding::too_few) {
      notes.push_back(list[n].job->name + ": time is held to its fixed tolerance, for " +
                      std::to_string(pairs[n].sample.size()) + " repeats against " +
                      std::to_string(pairs[n].reference.size()) + " cannot tell at p " + p_text(test.level) +
                      " in " + std::to_string(list.size()) + " tests; `run --resume --repeat 10` takes more");
    } else {
      checks.emplace(list[n].job->name, check_of(list[n], found[n], test));
    }
  }
  return checks;
}

}  // namespace cbc3d::reports

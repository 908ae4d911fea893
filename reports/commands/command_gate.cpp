// cbc3d-bench gate: a run against a baseline.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/one_line.hpp"
#include "reports/commands/commands.hpp"
#include "reports/gate/gate.hpp"

namespace cbc3d::reports {
namespace {

struct GateOptions {
  std::string folder, baseline, junit, reason;
  int threads = 0;
  bool quiet = false, test_times = false, partial = false;
  TimeTest time_test;
};

int update(const GateOptions& options, const std::vector<JobResult>& results) {
  const Json former = std::filesystem::exists(options.baseline) ? read_baseline(options.baseline) : Json();
  write_text_file(options.baseline,
                  make_baseline(results, former, options.reason, options.partial).dump(1) + "\n");
  if (!options.quiet) {
    std::cout << "wrote the baseline '" << options.baseline << "': " << options.reason << '\n';
  }
  return kExitSuccess;
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// Adds to GitHub's step summary, where the environment names one.
void add_to_step_summary(const std::string& text) {
  if (is_set("GITHUB_STEP_SUMMARY")) {
    std::ofstream summary(std::getenv("GITHUB_STEP_SUMMARY"), std::ios::app);
    summary << text;
    if (!summary.flush()) {
      std::cerr << "cannot write the step summary '" << std::getenv("GITHUB_STEP_SUMMARY") << "'\n";
    }
  }
}

int compare_and_report(const GateOptions& options) {
  const std::vector<JobResult> results = results_of(options.folder);
  if (!options.reason.empty()) {
    return update(options, results);
  }
  const CompareOptions how{options.test_times ? std::optional(options.time_test) : std::nullopt,
                           options.partial};
  const Verdict verdict = compare(results, read_baseline(options.baseline), how);
  if (!options.junit.empty()) {
    write_text_file(options.junit, to_junit(verdict));
  }
  if (is_set("GITHUB_ACTIONS")) {
    std::cout << to_annotations(verdict);
  }
  add_to_step_summary(to_step_summary(verdict));
  if (!options.quiet || !verdict.holds()) {
    std::cout << to_text(verdict);
  }
  return verdict.holds() ? kExitSuccess : kExitGateFailed;
}

/// A gate that errs says so in the places where its verdict is looked for, too.
int gate(const GateOptions& options) {
  try {
    return compare_and_report(options);
  } catch (const InputError& error) {
    const std::string reason = one_line(error.what());
    if (options.reason.empty()) {
      add_to_step_summary(to_step_summary_error(reason));
    }
    if (options.reason.empty() && !options.junit.empty()) {
      write_text_file(options.junit, to_junit_error(reason));
    }
    throw;
  }
}

void add_test_options(CLI::App* parser, GateOptions& options) {
  parser->add_flag("--test-times", options.test_times,
                   "times fall by the rank test of Mann and Whitney over the repeats, in place of a fixed "
                   "tolerance; ten repeats on both sides, interleaved, are a good number");
  parser
      ->add_option(
          "--time-figure", options.time_test.figure,
          "with --test-times: time_ratio, CPU time over the reference work's, or time_s.cpu, CPU time "
          "alone, for runs of one machine whose reference work is disturbed")
      ->check(CLI::IsMember({"time_ratio", "time_s.cpu"}))
      ->capture_default_str();
  parser
      ->add_option("--level", options.time_test.level,
                   "with --test-times: the probability of a false alarm, of all jobs together")
      ->check(number_between(1e-9, 0.5))
      ->capture_default_str();
  parser
      ->add_option("--least-change", options.time_test.least_change_percent,
                   "with --test-times: by how much a median must be slower to fall, %")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  parser->add_flag("--partial", options.partial,
                   "the run has only some of the baseline's jobs: the others do not fall, and keep their "
                   "figures on --update");
}

}  // namespace

Command add_gate_command(CLI::App& app) {
  auto options = std::make_shared<GateOptions>();
  CLI::App* parser = app.add_subcommand(
      "gate",
      "Compares a run with a baseline: counts of deterministic meshers exactly, quality, fidelity and "
      "memory within tolerances, CPU time as a ratio to a fixed piece of work. Exit code 1 when "
      "something fell");
  parser->add_option("DIR", options->folder, "folder of a run")->required();
  parser->add_option("--baseline", options->baseline, "JSON file of the baseline")->required();
  parser->add_option("--junit", options->junit, "write the checks as JUnit XML to this file");
  parser
      ->add_option("--update", options->reason,
                   "write the run's figures to the baseline instead, with this reason; tolerances stay")
      ->check([](const std::string& text) {
        return text.find_first_not_of(" \t") == std::string::npos ? "give a reason" : std::string();
      });
  add_test_options(parser, *options);
  add_idle_options(parser, options->threads, "comparing needs", options->quiet,
                   "print nothing when the gate holds");
  return {parser, [options] { return gate(*options); }};
}

}  // namespace cbc3d::reports

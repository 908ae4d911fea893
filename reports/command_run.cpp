// cbc3d-bench run: meshers on cases.
#include <algorithm>
#include <iostream>

#include "baselines/registry.hpp"
#include "cases/manifest.hpp"
#include "mesher/core/error.hpp"
#include "reports/commands.hpp"
#include "reports/output.hpp"
#include "reports/runner.hpp"
#include "reports/workplace.hpp"

namespace cbc3d::reports {
namespace {

struct RunCommandOptions {
  std::vector<std::string> suites, cases, meshers, data, settings;
  std::string out, parameter_set;
  RunOptions run;
  double memory_limit_gib = 16;
  OutputOptions output;
  bool strict = false;
};

template <class Things>
std::string names_of(const Things& things) {
  std::string names;
  for (const auto& thing : things) {
    names += (names.empty() ? "" : ", ") + thing.name;
  }
  return names;
}

std::vector<cases::Case> chosen_cases(const RunCommandOptions& options, const std::vector<cases::Case>& all) {
  if (options.suites.empty() == options.cases.empty()) {
    throw InputError("give either --suite or --case; `cbc3d-bench list suites` and `list cases` name them");
  }
  std::vector<cases::Case> chosen;
  for (const std::string& name : options.cases) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const cases::Case& c) { return c.name == name; });
    if (found == all.end()) {
      throw InputError("--case '" + name + "' is unknown; there are " + names_of(all));
    }
    chosen.push_back(*found);
  }
  for (const std::string& suite : options.suites) {
    const std::size_t before = chosen.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const cases::Case& c) {
      return std::find(c.suites.begin(), c.suites.end(), suite) != c.suites.end();
    });
    if (chosen.size() == before) {
      throw InputError("--suite '" + suite + "' is unknown; `cbc3d-bench list suites` names them");
    }
  }
  return chosen;
}

std::vector<baselines::Adapter> chosen_meshers(const std::vector<std::string>& names) {
  if (names.empty()) {
    return baselines::registry();
  }
  std::vector<baselines::Adapter> chosen;
  for (const std::string& name : names) {
    const baselines::Adapter* adapter = baselines::find_adapter(name);
    if (adapter == nullptr) {
      throw InputError("--mesher '" + name + "' is unknown; there are " + names_of(baselines::registry()));
    }
    chosen.push_back(*adapter);
  }
  return chosen;
}

/// MESHER.KEY=VALUE, ...
std::map<std::string, Parameters> parse_settings(const std::vector<std::string>& settings) {
  std::map<std::string, Parameters> parameters;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::size_t dot = setting.find('.');
    if (dot == std::string::npos || equals == std::string::npos || dot > equals || dot == 0) {
      throw InputError("--set '" + setting + "': give MESHER.KEY=VALUE, for example cgal.cell-size=2");
    }
    const std::string mesher = setting.substr(0, dot);
    if (baselines::find_adapter(mesher) == nullptr) {
      throw InputError("--set '" + setting + "': mesher '" + mesher + "' is unknown; there are " +
                       names_of(baselines::registry()));
    }
    parameters[mesher][setting.substr(dot + 1, equals - dot - 1)] = setting.substr(equals + 1);
  }
  return parameters;
}

int run(RunCommandOptions options) {
  const std::vector<cases::Case> all_cases = cases::load_cases(manifest_dir());
  options.run.out_dir = options.out;
  options.run.memory_limit_bytes = static_cast<std::int64_t>(options.memory_limit_gib * double(1 << 30));
  options.run.parameters = parse_settings(options.settings);
  const auto folders = data_dirs({options.data.begin(), options.data.end()});
  const auto cache_dir = options.run.out_dir / "images";
  Bench bench;
  bench.cases = chosen_cases(options, all_cases);
  if (!options.parameter_set.empty()) {
    for (cases::Case& subject : bench.cases) {
      cases::use_parameter_set(subject, options.parameter_set);
    }
  }
  bench.meshers = chosen_meshers(options.meshers);
  bench.bin_dir = bin_dir();
  bench.evaluate_command = {executable_file(), "evaluate"};
  bench.resolve_image = [&](const cases::Case& subject) {
    return cases::resolve_image(subject, folders, cache_dir);
  };
  Progress progress(options.output.quiet);
  const std::vector<Json> results = run_jobs(bench, options.run, progress);
  write_output(options.run.out_dir, results, all_cases, bench.bin_dir, options.output, progress);
  std::cout << summary_line(results) << '\n';
  const bool all_ok = std::all_of(results.begin(), results.end(),
                                  [](const Json& result) { return result.value("status", "") == "ok"; });
  return options.strict && !all_ok ? kExitJobFailed : kExitSuccess;
}

void add_choice_options(CLI::App* parser, RunCommandOptions& options) {
  parser->add_option("--suite", options.suites, "suites of cases (see: list suites)");
  parser->add_option("--case", options.cases, "cases (see: list cases)");
  parser->add_option("--mesher", options.meshers, "meshers; default: all (see: list meshers)");
  parser
      ->add_option("--out", options.out,
                   "folder for results.jsonl, meshes, tables and figures; made if need be")
      ->required();
  parser
      ->add_option(
          "--data", options.data,
          "folder with case images (may be given again); then those in CBC3D_DATA, then ../data beside the "
          "programs")
      ->allow_extra_args(false);
  parser->add_option("--parameter-set", options.parameter_set,
                     "a named set of the cases' manifests (equal_count, say), laid over their parameters");
  parser
      ->add_option("--set", options.settings,
                   "MESHER.KEY=VALUE: a parameter of a mesher (may be given again)")
      ->allow_extra_args(false);
}

void add_limit_options(CLI::App* parser, RunCommandOptions& options) {
  parser
      ->add_option("--threads", options.run.threads,
                   "thread counts, separated by commas; 0: all cores. Sequential meshers run once, with 1")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  parser->add_option("--repeat", options.run.repeats, "runs of every job")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parser->add_option("--timeout", options.run.timeout_s, "time limit of every child process, s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parser->add_option("--memory-limit", options.memory_limit_gib, "memory limit of every child process, GiB")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

Command add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunCommandOptions>();
  CLI::App* parser = app.add_subcommand("run",
                                        "Runs meshers on cases and writes results, tables and pictures. Exit "
                                        "code 0 once every job has its line");
  add_choice_options(parser, *options);
  add_limit_options(parser, *options);
  parser->add_flag("--resume", options->run.resume,
                   "go on with the results in --out: leave out jobs that have a line");
  parser->add_flag("--strict", options->strict, "exit code 3 when a job is not ok");
  parser->add_flag("!--no-pictures", options->output.pictures, "draw no cut sections and surfaces");
  parser->add_flag("--quiet", options->output.quiet, "no progress and no tables on the screen");
  return {parser, [options] { return run(*options); }};
}

}  // namespace cbc3d::reports

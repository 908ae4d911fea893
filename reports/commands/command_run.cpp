// cbc3d-bench run: meshers on cases.
#include <algorithm>
#include <iostream>

#include "mesher/core/error.hpp"
#include "reports/commands/commands.hpp"
#include "reports/commands/selection.hpp"
#include "reports/output/output.hpp"

namespace cbc3d::reports {
namespace {

struct RunCommandOptions {
  Selection selection;
  std::string out, shard = "1/1";
  RunOptions run;
  double memory_limit_gib = 16;
  OutputOptions output;
  bool strict = false;
};

int run(RunCommandOptions options) {
  options.run.out_dir = options.out;
  options.run.memory_limit_bytes = static_cast<std::int64_t>(options.memory_limit_gib * double(1 << 30));
  options.run.parameters = parse_settings(options.selection);
  options.run.shard = parse_shard(options.shard);
  if (options.run.budgets.empty() && selects_front(options.selection)) {
    options.run.budgets = kFrontBudgets;
  }
  const Bench bench = make_bench(options.selection, options.run.out_dir);
  TerminalProgress progress(options.output.quiet);
  const std::vector<JobResult> results = decode_lines(run_jobs(bench, options.run, progress));
  write_output(options.run.out_dir, results, cases_of(options.selection.manifests), bench.bin_dir,
               options.output, progress);
  std::cout << summary_line(results) << '\n';
  const bool all_ok =
      std::all_of(results.begin(), results.end(), [](const JobResult& result) { return result.is_ok(); });
  return options.strict && !all_ok ? kExitJobFailed : kExitSuccess;
}

void add_resume_options(CLI::App* parser, RunCommandOptions& options) {
  parser->add_flag("--resume", options.run.resume,
                   "go on with the results in --out: leave out jobs that have a line");
  parser->add_flag("--rerun-changed", options.run.rerun_changed,
                   "with --resume: run jobs again whose case, parameters or program have changed; without it "
                   "such a change is an error");
  parser->add_flag("--retry-failed", options.run.retry_failed,
                   "with --resume: run jobs again that are not ok");
  parser
      ->add_option(
          "--shard", options.shard,
          "I/N: every Nth job, from the Ith on, each shard with an --out of its own; `merge` joins them")
      ->capture_default_str();
}

}  // namespace

Command add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunCommandOptions>();
  CLI::App* parser = app.add_subcommand("run",
                                        "Runs meshers on cases and writes results, tables and pictures. Exit "
                                        "code 0 once every job has its line");
  add_selection_options(parser, options->selection);
  parser
      ->add_option("-o,--out", options->out,
                   "folder for results.jsonl, meshes, tables and figures; made if need be")
      ->required();
  parser
      ->add_option(
          "--budgets", options->run.budgets,
          "numbers of elements, separated by commas: each mesher's size dial is turned until its mesh has "
          "about so many, a job for each; default with the suite front: 25000,50000,100000,200000,400000")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  add_limit_options(parser, options->run, options->memory_limit_gib);
  parser->add_flag("--solve", options->run.solve,
                   "solve Poisson's equation on every mesh (cbc3d-solve, a process of its own under the same "
                   "limits) and give the errors; lines that are there already are not solved again");
  add_resume_options(parser, *options);
  parser->add_flag("--interleave", options->run.interleaved,
                   "all first repeats before the second ones, so that a machine that gets slower or busier "
                   "hits all meshers alike");
  parser->add_flag("--strict", options->strict, "exit code 3 when a job is not ok");
  parser->add_flag("!--no-pictures", options->output.pictures, "draw no cut sections and surfaces");
  parser->add_flag("--quiet", options->output.quiet, "no progress and no tables on the screen");
  return {parser, [options] { return run(*options); }};
}

}  // namespace cbc3d::reports

// cbc3d-bench sweep: times over threads, samples of all jobs taken in turn.
#include <iostream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/commands/commands.hpp"
#include "reports/commands/selection.hpp"
#include "reports/output/output.hpp"
#include "reports/sweep/sweep.hpp"
#include "reports/tables/microbenchmark_table.hpp"

namespace cbc3d::reports {
namespace {

struct SweepOptions {
  Selection selection;
  std::string out;
  std::vector<std::filesystem::path> microbenchmarks;
  RunOptions run;
  double memory_limit_gib = 16;
  OutputOptions output;
};

int sweep(SweepOptions options) {
  options.run.out_dir = options.out;
  options.run.interleaved = true;
  options.run.memory_limit_bytes = static_cast<std::int64_t>(options.memory_limit_gib * double(1 << 30));
  options.run.parameters = parse_settings(options.selection);
  const Json microbenchmarks = read_microbenchmarks(options.microbenchmarks);  // complains before the work
  const Bench bench = make_bench(options.selection, options.run.out_dir);
  TerminalProgress progress(options.output.quiet);
  const std::vector<JobResult> results = decode_lines(run_jobs(bench, options.run, progress));
  write_text_file(options.run.out_dir / "sweep.json", to_json(sweep_points(results)).dump(1) + "\n");
  if (!options.microbenchmarks.empty()) {
    write_text_file(options.run.out_dir / "microbenchmarks.json", microbenchmarks.dump(1) + "\n");
  }
  options.output.pictures = false;
  write_output(options.run.out_dir, results, cases_of(options.selection.manifests), bench.bin_dir,
               options.output, progress);
  std::cout << summary_line(results) << '\n';
  return kExitSuccess;
}

}  // namespace

Command add_sweep_command(CLI::App& app) {
  auto options = std::make_shared<SweepOptions>();
  options->run.repeats = 5;
  CLI::App* parser = app.add_subcommand(
      "sweep",
      "Measures times over thread counts: every repeat takes one sample of each job in turn, all samples are "
      "kept; medians, spreads, speed-up and efficiency with errors, in all and for every stage");
  add_selection_options(parser, options->selection);
  parser->add_option("-o,--out", options->out, "folder for results, tables and plots; made if need be")
      ->required();
  add_limit_options(parser, options->run, options->memory_limit_gib);
  parser->add_option("--microbenchmarks", options->microbenchmarks,
                     "Google Benchmark's JSON files, put into tables and report");
  parser->add_flag("--resume", options->run.resume, "go on with the samples in --out");
  parser->add_flag(
      "--rerun-changed", options->run.rerun_changed,
      "with --resume: take samples again of jobs whose case, parameters or program have changed");
  parser->add_flag("--quiet", options->output.quiet, "no progress and no tables on the screen");
  return {parser, [options] { return sweep(*options); }};
}

}  // namespace cbc3d::reports

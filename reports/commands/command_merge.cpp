// cbc3d-bench merge: the folders of several runs made one.
#include <iostream>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "reports/commands/commands.hpp"
#include "reports/results/job_result.hpp"
#include "reports/run/merge.hpp"

namespace cbc3d::reports {
namespace {

struct MergeCommandOptions {
  std::vector<std::string> folders;
  std::string out;
  MergeOptions merge;
  int threads = 0;
  bool quiet = false;
};

int merge(const MergeCommandOptions& options) {
  const std::vector<JobResult> results =
      decode_lines(merge_runs({options.folders.begin(), options.folders.end()}, options.out, options.merge));
  if (!options.quiet) {
    std::cout << summary_line(results) << '\n';
  }
  return kExitSuccess;
}

}  // namespace

Command add_merge_command(CLI::App& app) {
  auto options = std::make_shared<MergeCommandOptions>();
  CLI::App* parser = app.add_subcommand(
      "merge",
      "Joins the folders of several runs, such as the shards of a job array, in one; then `tables` "
      "and `report` work on that");
  parser->add_option("DIR", options->folders, "folders of runs")->required();
  parser->add_option("-o,--out", options->out, "folder to make")->required();
  parser
      ->add_option("--expect", options->merge.expected,
                   "jobs that there should be: with others nothing is merged, exit code 3")
      ->check(whole_number_between(1, 1000000));
  parser->add_flag("--replace", options->merge.replace, "replace the results that --out holds already");
  add_idle_options(parser, options->threads, "merging needs", options->quiet, "no summary on the screen");
  return {parser, [options] { return merge(*options); }};
}

}  // namespace cbc3d::reports

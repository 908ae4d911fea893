// cbc3d-bench tables: tables and pictures again from results.jsonl.
#include <iostream>

#include "cases/manifest.hpp"
#include "mesher/core/error.hpp"
#include "reports/commands/commands.hpp"
#include "reports/output/output.hpp"
#include "reports/run/workplace.hpp"

namespace cbc3d::reports {
namespace {

struct TablesOptions {
  std::string folder;
  OutputOptions output;
  int threads = 0;
};

int write_again(const TablesOptions& options) {
  const std::vector<JobResult> results = results_of(options.folder);
  TerminalProgress progress(options.output.quiet);
  write_output(options.folder, results, cases::load_cases(manifest_dir()), bin_dir(), options.output,
               progress);
  return kExitSuccess;
}

}  // namespace

Command add_tables_command(CLI::App& app) {
  auto options = std::make_shared<TablesOptions>();
  CLI::App* parser = app.add_subcommand("tables", "Writes tables and pictures again from DIR/results.jsonl");
  parser->add_option("DIR", options->folder, "folder of a run")->required();
  parser
      ->add_option("--format", options->output.formats,
                   "forms of the tables, separated by commas: csv, json, md, tex")
      ->delimiter(',')
      ->capture_default_str();
  parser->add_flag("!--no-pictures", options->output.pictures, "draw no cut sections and surfaces");
  add_idle_options(parser, options->threads, "tables need", options->output.quiet,
                   "no progress and no tables on the screen");
  return {parser, [options] { return write_again(*options); }};
}

}  // namespace cbc3d::reports

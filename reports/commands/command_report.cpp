// cbc3d-bench report: a run as one HTML file.
#include <iostream>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/charts/pictures.hpp"
#include "reports/commands/commands.hpp"
#include "reports/commands/selection.hpp"
#include "reports/output/html.hpp"
#include "reports/output/output.hpp"
#include "reports/run/workplace.hpp"
#include "reports/tables/microbenchmark_table.hpp"
#include "reports/tables/tables.hpp"
#include "reports/viewer/view_section.hpp"

namespace cbc3d::reports {
namespace {

struct ReportOptions {
  std::string folder, out, title, manifests;
  std::vector<std::filesystem::path> microbenchmarks;
  bool pictures = true, quiet = false;
  int threads = 0;
  ViewOptions view;
};

int write_report(const ReportOptions& options) {
  require_writable(options.out);
  const std::filesystem::path folder = options.folder;
  Report report;
  report.results = results_of(folder);
  const std::vector<cases::Case> cases = cases_of(options.manifests);
  report.title = options.title.empty() ? "CBC3D: comparison of meshers" : options.title;
  report.tables = build_tables({report.results, cases, folder});
  if (!options.microbenchmarks.empty()) {
    report.tables.push_back(microbenchmark_table(read_microbenchmarks(options.microbenchmarks)));
  }
  report.figures = all_figures(folder, report.results);
  report.picture_dir = folder / "figures" / "small";
  TerminalProgress progress(options.quiet);
  if (options.pictures && !std::filesystem::exists(report.picture_dir)) {
    draw_pictures(folder, report.results, bin_dir(), progress);
  }
  progress.step("meshes of the 3D view", 1);
  report.view = view_section(folder, report.results, options.view);
  progress.done();
  write_text_file(options.out, to_html(report));
  if (!options.quiet) {
    std::cout << options.out << ": " << summary_line(report.results) << '\n';
  }
  return kExitSuccess;
}

}  // namespace

Command add_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* parser = app.add_subcommand(
      "report",
      "Writes a run as one HTML file that opens from disk, on a phone and in print: tables, plots, a 3D view "
      "of the meshes, pictures, failed jobs, provenance");
  parser->add_option("DIR", options->folder, "folder of a run or a sweep")->required();
  parser->add_option("-o,--out", options->out, "HTML file to write")->required();
  parser->add_option("--title", options->title, "title of the report");
  parser->add_option("--microbenchmarks", options->microbenchmarks,
                     "Google Benchmark's JSON files to put in");
  add_manifests_option(parser, options->manifests);
  parser
      ->add_option("--view-megabytes", options->view.megabytes,
                   "MB of the file for the meshes of the 3D view, which are simplified to fit; 0: no view")
      ->capture_default_str()
      ->check(number_between(0, 1000));
  parser->add_flag("!--no-pictures", options->pictures, "do not draw pictures that are missing");
  add_idle_options(parser, options->threads, "writing needs", options->quiet, "no progress");
  return {parser, [options] { return write_report(*options); }};
}

}  // namespace cbc3d::reports

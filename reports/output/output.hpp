// What a run leaves beside its results file: tables, plots and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/core/case.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "reports/charts/figures.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

struct OutputOptions {
  std::vector<std::string> formats{"csv", "json", "md", "tex"};  ///< forms of the tables
  bool pictures = true;                                          ///< draw cut sections and surfaces
  bool quiet = false;                                            ///< print no tables
};

/// Every plot of a run, with those of a sweep.
std::vector<Figure> all_figures(const std::filesystem::path& folder, const std::vector<JobResult>& results);

/// Writes `folder`/tables and `folder`/figures and prints the tables as Markdown to standard output.
void write_output(const std::filesystem::path& folder, const std::vector<JobResult>& results,
                  const std::vector<cases::Case>& cases, const std::filesystem::path& bin_dir,
                  const OutputOptions& options, TerminalProgress& progress);

}  // namespace cbc3d::reports

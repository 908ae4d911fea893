// What a run leaves beside its results file: tables and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "mesher/core/progress.hpp"
#include "reports/result.hpp"

namespace cbc3d::reports {

struct OutputOptions {
  std::vector<std::string> formats{"csv", "json", "md", "tex"};  ///< forms of the tables
  bool pictures = true;                                          ///< draw cut sections and surfaces
  bool quiet = false;                                            ///< print no tables
};

/// Writes `folder`/tables and `folder`/figures and prints the tables as Markdown to standard output.
void write_output(const std::filesystem::path& folder, const std::vector<Json>& results,
                  const std::vector<cases::Case>& cases, const std::filesystem::path& bin_dir,
                  const OutputOptions& options, Progress& progress);

}  // namespace cbc3d::reports

// The pictures of a run: for every case and mesher a cut section and a surface.
#pragma once

#include <filesystem>
#include <vector>

#include "mesher/core/terminal_progress.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// Draws the mesh of the first good run of every case and mesher into `out_dir`/figures, each in a child
/// process under a virtual X server and a time limit. Where drawing is not possible, one line says so, and
/// nothing else happens. Returns the number of pictures drawn.
int draw_pictures(const std::filesystem::path& out_dir, const std::vector<JobResult>& results,
                  const std::filesystem::path& bin_dir, TerminalProgress& progress);

}  // namespace cbc3d::reports

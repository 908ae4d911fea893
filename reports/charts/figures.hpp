// The figures of a run that are drawn from its numbers: histograms of the dihedral angles, distances and
// times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/terminal_progress.hpp"
#include "reports/charts/figure.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// For every case the distribution of the dihedral angles in steps of 5 degrees with all meshers; over the
/// cases every metric that names a chart in the catalog; for every case all meshers in the planes
/// of distance against smallest dihedral angle and against element count. Of a run with budgets the fronts
/// (front_charts.hpp) in place of all these.
std::vector<Figure> result_figures(const std::vector<JobResult>& results);

/// Writes each figure as NAME.svg into `folder`, which is made, and as NAME.png where rsvg-convert is there;
/// one line says so where it is not.
void write_figures(const std::vector<Figure>& figures, const std::filesystem::path& folder,
                   TerminalProgress& progress);

}  // namespace cbc3d::reports

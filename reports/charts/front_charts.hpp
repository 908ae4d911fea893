// The fronts of a run with budgets, as figures.
#pragma once

#include <vector>

#include "reports/charts/figure.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// For every case and figure of the fronts three planes with a line for each mesher: over elements, over
/// unknowns (vertices inside, or the unknowns of the solved problem where there was one) and over meshing
/// time. They are called front-CASE-FIGURE-AXIS. Empty when no job had a budget.
std::vector<Figure> front_charts(const std::vector<JobResult>& results);

}  // namespace cbc3d::reports

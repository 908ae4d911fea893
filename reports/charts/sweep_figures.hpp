// The plots of a sweep over threads.
#pragma once

#include <vector>

#include "reports/charts/figures.hpp"
#include "reports/sweep/sweep.hpp"

namespace cbc3d::reports {

/// For every case the times and the speed-ups over the threads, and for every mesher its stages.
std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points);

}  // namespace cbc3d::reports

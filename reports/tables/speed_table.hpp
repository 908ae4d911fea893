// What the meshers cost for what they give.
#pragma once

#include <vector>

#include "cases/core/case.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// Table `speed`: for every case elements, seconds (meshing alone and with files), CPU seconds, threads,
/// elements per second, the paper's Hausdorff distance and peak memory; then elements, time and CPU time as
/// multiples of those of every column of cbc3d-paper and cbc3d; then core-seconds, that is seconds of meshing
/// times threads, beside the paper's own (on its image and machine) and the paper's over ours. Medians of the
/// repeats.
Table speed_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases);

}  // namespace cbc3d::reports

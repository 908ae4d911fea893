// What the meshers cost for what they give.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `speed`: for every case the metrics that name it in the catalog (elements, seconds, memory, ...);
/// then elements, time and CPU time as multiples of those of every column of cbc3d-paper and cbc3d; then
/// core-seconds, that is seconds of meshing times threads, beside the paper's own (on its image and machine)
/// and the paper's over ours. Medians of the repeats, with intervals from six repeats on; of times over
/// others' the cells say whether the rank test tells them apart (reports/statistics), all times of the table
/// together.
Table speed_table(const TableInput& input);

}  // namespace cbc3d::reports

// What a good mesh should have, mesher by mesher, and what it misses.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `targets`: for every case the metrics that name it in the catalog, with their targets. A cell beyond
/// its target is marked, with the worst label or the labels in question; the last row of a case counts them.
Table target_table(const TableInput& input);

}  // namespace cbc3d::reports

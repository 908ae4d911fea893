// How far every mesher is from the best one, figure by figure, and its hard faults.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `targets`: for every case the metrics that have a purpose in the catalog, purpose by purpose, each
/// as a multiple of the best of the meshers compared on that case: 1 is best and more is worse, whichever way
/// the figure itself goes. The figure stands beside it in brackets, with the label where it is the worst.
/// Where the best is 0, or below, there is no multiple and the row, which says so, has the figures
/// themselves. Beneath stand the hard faults as counts, each that is not 0 marked, and how many kinds of them
/// there are.
Table target_table(const TableInput& input);

}  // namespace cbc3d::reports

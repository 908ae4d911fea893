// How far every mesher is from the best one, figure by figure, and its hard faults.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `targets`: for every case, and budget of it where it has budgets, the metrics that have a purpose in
/// the catalog, purpose by purpose, each as a multiple of the best of the meshers compared on that case: 1 is
/// best and more is worse, whichever way the figure itself goes. The figure stands beside it in brackets,
/// with the label where it is the worst. Figures at a budget are those at exactly so many elements,
/// interpolated over the mesher's budgets (front.hpp); a mesher without such a mesh has none, and the row
/// says why. Without budgets the meshes have the elements that their parameters gave them: the title says how
/// many. Where the best is 0, or below, there is no multiple and the row, which says so, has the figures
/// themselves. Beneath stand the hard faults of the meshes themselves as counts, each that is not 0 marked,
/// and how many kinds of them there are.
Table target_table(const TableInput& input);

}  // namespace cbc3d::reports

// Meshers at equal numbers of elements.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `front`: for every case and budget the number of elements that each mesher came to, with the reason
/// where it is not about the budget, and each figure at exactly the budget, interpolated in log-log along the
/// mesher's budgets; then who is best, by which factor the second best is worse, and by which cbc3d is worse
/// than the best. Without rows when no job had a budget.
Table front_table(const TableInput& input);

/// Table `front_losses`: the rows of `front` in which cbc3d is worse than another mesher, the worst first. A
/// figure that cbc3d has not at a budget while another has it is a loss too.
Table front_loss_table(const TableInput& input);

}  // namespace cbc3d::reports

// The parameters of a run.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `input_parameters`: the parameters that each mesher ran with, the cases they differ in, and the
/// paper's.
Table input_parameter_table(const TableInput& input);

}  // namespace cbc3d::reports

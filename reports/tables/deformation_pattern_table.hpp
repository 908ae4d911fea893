// The deformation's patterns beside the paper's.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `deformation_patterns`: a row for every good job of a case that names its deformation pattern:
/// target points, distances before (by the job of the case "before" without iterations) and after, the
/// metrics that name the table in the catalog, seconds of the deformation, and the paper's.
Table deformation_pattern_table(const TableInput& input);

}  // namespace cbc3d::reports

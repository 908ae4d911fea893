// The tables of what went into a run, image data and input parameters, and of the deformation's patterns.
#pragma once

#include <vector>

#include "cases/core/case.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// Type, materials, spacing and size of every case's image that was read, and of the paper's.
Table image_data_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases);

/// The parameters that each mesher ran with, the cases they differ in, and the paper's.
Table input_parameter_table(const std::vector<Json>& results);

/// A row for every good job of a case that names its deformation pattern: target points, distances before (by
/// the job of the case "before" without iterations) and after, seconds of the deformation, and the paper's.
Table deformation_pattern_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases);

}  // namespace cbc3d::reports

// The paper's figures beside ours, from the cases' manifests.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cases/core/case.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// The paper's figure under `key` (hausdorff_mm, time_s, ...) for `runs`, the results of one case and column:
/// that under the mesher's name in the case's manifest, or under its method's (cbc3d-paper and cbc3d are
/// one, a mixed mesh is not), or for a distance that of the table on deformation. None without runs or key.
std::optional<double> paper_figure(const std::vector<cases::Case>& cases, const Runs& runs,
                                   std::string_view key);

}  // namespace cbc3d::reports

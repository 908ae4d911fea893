// Going on with a folder that holds results already.
#pragma once

#include <filesystem>
#include <vector>

#include "reports/run/runner.hpp"

namespace cbc3d::reports {

/// The lines of `file` that stay for a run of `jobs`. Lines of jobs that are to run again (changed ones with
/// `rerun_changed`, those that are not ok with `retry_failed`) are moved to results.superseded.jsonl beside
/// it. A changed evaluator is said, for figures of two evaluators then stand side by side. Throws InputError
/// when there are lines and `resume` is off, or a job's case, parameters or program changed and
/// `rerun_changed` is off.
std::vector<Json> lines_to_keep(const std::filesystem::path& file, const std::vector<Job>& jobs,
                                const Bench& bench, const RunOptions& options, TerminalProgress& progress);

}  // namespace cbc3d::reports

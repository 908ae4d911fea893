// The stored baseline of a gate.
//
// {"format": "cbc3d-baseline-1",
//  "history": [{"utc": "...", "git_commit": "...", "reason": "why the figures changed",
//               "jobs": [names]}],                          newest last; jobs: of an update of some alone
//  "tolerances": {"distance": {"relative": 0.05, "absolute": 0.01}, ...},    over those of
//  metrics/catalog.hpp "known_failures": [{"job": "liver, cgal, 1 thread", "figure": "fidelity.hausdorff_mm",
//  "reason": "..."}], "jobs": [{"case": "...", "mesher": "...", "threads": 1, "parameters": {},
//  "parameters_in_force": {},
//            "deterministic": true, "missing_labels": [], "figures": {"counts.tets": 123, ...},
//            "samples": {"time_ratio": [...], "time_s.cpu": [...]}}]}
// Repeats of a job are one entry: the figures of deterministic meshers must be the same in all of them, time
// and memory are the smallest, the others the median; `samples` has what tests need of every repeat.
// "time_ratio" is CPU time over that of the fixed piece of work (reference_work.hpp) done beside it in as
// many threads, so that a slower or busier machine does not count. A known failure names a job and a figure
// as the gate does: a key of the catalog, or status, labels, repeats or parameters.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// Reads and checks a baseline. Throws InputError naming file, key and remedy.
Json read_baseline(const std::filesystem::path& file);

/// A baseline of a run's good jobs. `former` (may be null) gives its tolerances, history and known failures;
/// a figure that is a known failure keeps its former value, a job whose status is one its former entry.
/// `is_partial`: jobs that were not run keep theirs too. Throws InputError when another job of the run is not
/// ok, or its repeats differ although its mesher is deterministic.
Json make_baseline(const std::vector<JobResult>& results, const Json& former, const std::string& reason,
                   bool is_partial = false);

/// As GateJob::name.
std::string name_of_entry(const Json& entry);

/// The known failures of a baseline, an empty list where it has none.
Json known_failures_of(const Json& baseline);

/// Whether a figure of a job is one of the known failures.
bool is_known_failure(const Json& baseline, const std::string& job, const std::string& figure);

}  // namespace cbc3d::reports

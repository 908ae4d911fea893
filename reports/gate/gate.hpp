// The gate: a run compared with a stored baseline.
//
// A baseline is a JSON file:
// {"format": "cbc3d-baseline-1",
//  "history": [{"utc": "...", "git_commit": "...", "reason": "why the figures changed"}],    newest last
//  "tolerances": {"distance": {"relative": 0.05, "absolute": 0.01}, ...},    over those of
//  metrics/catalog.hpp "jobs": [{"case": "...", "mesher": "...", "threads": 1, "parameters": {},
//  "deterministic": true,
//            "missing_labels": [], "figures": {"counts.tets": 123, ...}}]}
// Repeats of a job are one entry: the figures of deterministic meshers must be the same in all of them, time
// and memory are the smallest, the others the median. "time_ratio" is CPU time over that of the fixed piece
// of work (reference_work.hpp) done beside it in as many threads, so that a slower or busier machine does not
// count.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// One comparison.
struct Check {
  std::string job;     ///< "liver, cgal, 1 thread"
  std::string figure;  ///< "counts.tets", "labels", "status", ...
  bool fell = false;
  bool better = false;  ///< by more than the tolerance
  double severity = 0;  ///< change over what is allowed; larger is worse
  std::string text;     ///< one line: what it was, is, and may be
};

struct Verdict {
  std::vector<Check> checks;       ///< those that fell first, the worst at the head
  std::vector<std::string> notes;  ///< what was not compared
  [[nodiscard]] std::size_t fallen() const;
  [[nodiscard]] bool holds() const { return fallen() == 0; }
};

/// Reads and checks a baseline. Throws InputError naming file, key and remedy.
Json read_baseline(const std::filesystem::path& file);

/// A baseline of a run's good jobs. `former` (may be null) gives its tolerances and history. Throws
/// InputError when a job of the run is not ok, or its repeats differ although its mesher is deterministic.
Json make_baseline(const std::vector<JobResult>& results, const Json& former, const std::string& reason);

Verdict compare(const std::vector<JobResult>& results, const Json& baseline);

/// JUnit's XML, a test case for every check.
std::string to_junit(const Verdict& verdict);
/// Lines for people: what fell, worst first, then what got better, notes and a count.
std::string to_text(const Verdict& verdict);
/// GitHub's step summary.
std::string to_step_summary(const Verdict& verdict);
/// The same of a gate that could compare nothing, for this reason.
std::string to_junit_error(const std::string& reason);
std::string to_step_summary_error(const std::string& reason);
/// GitHub's annotations, a line for every check that fell.
std::string to_annotations(const Verdict& verdict);

}  // namespace cbc3d::reports

// The gate: a run compared with a stored baseline (baseline.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/gate/baseline.hpp"
#include "reports/gate/check.hpp"
#include "reports/gate/time_check.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

struct CompareOptions {
  std::optional<TimeTest> time_test = {};  ///< none: time has a fixed tolerance
  bool is_partial = false;                 ///< jobs of the baseline that were not run do not count
};

struct Verdict {
  std::vector<Check> checks;       ///< those that fell first, the worst at the head
  std::vector<std::string> notes;  ///< what was not compared, and times that hold by the test
  [[nodiscard]] std::size_t fallen() const;
  [[nodiscard]] std::size_t count(Known known) const;
  [[nodiscard]] bool holds() const { return fallen() == 0; }
};

Verdict compare(const std::vector<JobResult>& results, const Json& baseline,
                const CompareOptions& options = {});

/// JUnit's XML, a test case for every check; known failures are skipped ones.
std::string to_junit(const Verdict& verdict);
/// Lines for people: what fell, worst first, then known failures, what got better, notes and a count.
std::string to_text(const Verdict& verdict);
/// GitHub's step summary.
std::string to_step_summary(const Verdict& verdict);
/// GitHub's annotations, a line for every check that fell.
std::string to_annotations(const Verdict& verdict);

}  // namespace cbc3d::reports

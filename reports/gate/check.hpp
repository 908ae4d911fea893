// One comparison of the gate.
#pragma once

#include <string>

#include "metrics/catalog.hpp"
#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// Whether a check is on the baseline's list of known failures.
enum class Known { no, fails, passes };

struct Check {
  std::string job;      ///< "liver, cgal, 1 thread"
  std::string figure;   ///< "counts.tets", "labels", "status", ...
  bool fell = false;    ///< and is not a known failure
  bool better = false;  ///< by more than the tolerance
  double severity = 0;  ///< change over what is allowed; larger is worse
  std::string text;     ///< one line: what it was, is, and may be
  Known known = Known::no;
};

/// A check that fell whatever the tolerances.
Check fallen(const std::string& job, const std::string& figure, const std::string& text);

/// "1.5000 mm": a value of a result line in the unit in which it is shown.
std::string with_unit(double value, const metrics::Metric& metric);

/// Compares one figure. `allowed`: the change that is let pass.
Check check_figure(const std::string& job, const metrics::Metric& metric, double was, double is,
                   double allowed);

/// The change that is let pass of a figure that was `was`, by the tolerances of a baseline.
double allowed_change(const metrics::Metric& metric, double was, bool deterministic, const Json& tolerances);

}  // namespace cbc3d::reports

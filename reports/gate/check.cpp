#include "reports/gate/check.hpp"

#include <algorithm>
#include <cmath>

#include "reports/results/format_number.hpp"

namespace cbc3d::reports {
namespace {

using metrics::Metric;

constexpr double kUnbounded = 1e9;  ///< severity of what has no tolerance

}  // namespace

std::string with_unit(double value, const Metric& metric) {
  const double shown = metric.scale * value;
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  const int decimals = metric.scale != 1 ? 1 : whole ? 0 : 4;
  return format_number(shown, decimals) + (metric.unit.empty() ? "" : " " + std::string(metric.unit));
}

Check check_figure(const std::string& job, const Metric& metric, double was, double is, double allowed) {
  const double change = is - was;
  const double worse = metric.worse == metrics::Worse::lower    ? -change
                       : metric.worse == metrics::Worse::higher ? change
                                                                : std::abs(change);
  Check check{job, std::string(metric.key), worse > allowed, -worse > allowed, 0, ""};
  check.severity = allowed > 0 ? worse / allowed : kUnbounded + worse;
  const std::string sign = change > 0 ? "+" : "";
  check.text = std::string(words(metric)) + " was " + with_unit(was, metric) + ", is " +
               with_unit(is, metric) + " (" + sign + with_unit(change, metric) +
               (was != 0 ? ", " + sign + format_number(100 * change / std::abs(was), 1) + " %" : "") +
               "; allowed " + with_unit(allowed, metric) + ")";
  return check;
}

Check fallen(const std::string& job, const std::string& figure, const std::string& text) {
  return {job, figure, true, false, 2 * kUnbounded, text};
}

double allowed_change(const Metric& metric, double was, bool deterministic, const Json& tolerances) {
  if (metric.gate == &metrics::kExact || (metric.gate == &metrics::kCounts && deterministic)) {
    return 0;
  }
  const Json& tolerance = tolerances.at(std::string(metric.gate->name));
  return std::max(tolerance["relative"].get<double>() * std::abs(was), tolerance["absolute"].get<double>());
}

}  // namespace cbc3d::reports

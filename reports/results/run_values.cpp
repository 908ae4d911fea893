#include "reports/results/run_values.hpp"

#include <algorithm>

#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {

FigureOf shown_figure(metrics::MetricId id) {
  return [id](const JobResult& result) -> std::optional<double> {
    const auto& value = result.figures[id];
    return value ? std::optional(metrics::metric(id).scale * *value) : std::nullopt;
  };
}

std::vector<double> values_of(const Runs& runs, const FigureOf& figure) {
  std::vector<double> values;
  for (const JobResult* run : runs) {
    const auto value = run->is_ok() ? figure(*run) : std::nullopt;
    if (value) {
      values.push_back(*value);
    }
  }
  return values;
}

std::optional<double> median_of(const Runs& runs, const FigureOf& figure) {
  const std::vector<double> values = values_of(runs, figure);
  return values.empty() ? std::nullopt : std::optional(median(values));
}

const JobResult* first_good(const Runs& runs) {
  const auto found =
      std::find_if(runs.begin(), runs.end(), [](const JobResult* run) { return run->is_ok(); });
  return found == runs.end() ? nullptr : *found;
}

}  // namespace cbc3d::reports

// A figure over several runs of a job.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// A figure of a result; none when the result does not have it.
using FigureOf = std::function<std::optional<double>(const JobResult& result)>;

/// A metric's figure in the unit in which it is shown (Metric::unit).
FigureOf shown_figure(metrics::MetricId id);

/// The figures of those runs that are ok and have it, in their order.
std::vector<double> values_of(const Runs& runs, const FigureOf& figure);

/// Their median; none without any.
std::optional<double> median_of(const Runs& runs, const FigureOf& figure);

/// The first run that is ok; null: none is.
const JobResult* first_good(const Runs& runs);

}  // namespace cbc3d::reports

// A history in tables.
#pragma once

#include <vector>

#include "reports/history/changes.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// The figures that `history show` has where none are named: time, memory, elements, worst angle, distance.
std::vector<metrics::MetricId> shown_metrics();

/// A job's figures at its last `most` commits, newest last. A figure from which on it is another is marked.
Table job_table(const History& history, std::size_t job, const std::vector<metrics::MetricId>& ids,
                const std::vector<Change>& changes, std::size_t most);

/// The changes with their commits, newest last.
Table change_table(const History& history, const std::vector<Change>& changes, const std::string& name,
                   const std::string& title);

/// "+8.1 %"; of a figure that was 0 the difference.
std::string change_text(const Change& change);

/// "CPU time over the reference work's", with its unit; of a failure "status".
std::string figure_name(const Change& change);

}  // namespace cbc3d::reports

// A history as one HTML page that needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "reports/history/changes.hpp"

namespace cbc3d::reports {

/// The changes in tables, those for the worse first; for every job a plot of each figure that is not the same
/// at every commit, with its changes marked; and the commits with their dates, machines and versions. Names
/// from outside are escaped.
std::string history_page(const std::string& title, const History& history, const std::vector<Change>& changes,
                         const std::vector<metrics::MetricId>& ids);

}  // namespace cbc3d::reports

// What a changed parameter is and what it cost.
#pragma once

#include <string>
#include <vector>

#include "reports/gate/check.hpp"

namespace cbc3d::reports {

/// "parameter size was 2, is 1.5; parameter seed was not given, is 3": objects of texts by key.
std::string changes_of(const Json& were, const Json& are);

/// "It cost: TIME; ...; it gained: ..." of the checks beyond their tolerances, the worst first, and of time
/// in any case.
std::string cost_of_change(std::vector<Check> checks);

}  // namespace cbc3d::reports

// How figures are written everywhere.
#pragma once

#include <string>

namespace cbc3d::reports {

/// A number with that many decimals and commas between the thousands.
std::string format_number(double value, int decimals);

}  // namespace cbc3d::reports

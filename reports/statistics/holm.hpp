// Several tests at once: S. Holm, A simple sequentially rejective multiple test procedure, Scand. J. Stat. 6
// (1979).
#pragma once

#include <vector>

namespace cbc3d::reports {

/// The p-values, adjusted so that those at most L are what the procedure rejects at the level L: with that
/// probability or less any of them is a chance find, however the tests depend on each other.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace cbc3d::reports

// Statistics that one disturbed sample does not upset.
#pragma once

#include <vector>

namespace cbc3d::reports {

/// The middle value, or the mean of the two middle ones. `values` must not be empty.
double median(std::vector<double> values);

/// Median absolute deviation times 1.4826: the standard deviation, if the values were normally distributed.
double spread(const std::vector<double>& values);

/// Standard error of the median, by the spread of the values: 1.2533 spread / sqrt(n); 0 for one value.
double median_error(const std::vector<double>& values);

/// Values farther from the median than 3.5 spreads (Iglewicz and Hoaglin), and by more than 2 % of it; none
/// among fewer than 4.
std::vector<bool> outliers(const std::vector<double>& values);

}  // namespace cbc3d::reports

#include "reports/statistics/robust.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::reports {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double spread(const std::vector<double>& values) {
  constexpr double kNormal = 1.4826;
  const double centre = median(values);
  std::vector<double> deviations(values);
  for (double& value : deviations) {
    value = std::abs(value - centre);
  }
  return kNormal * median(deviations);
}

double median_error(const std::vector<double>& values) {
  constexpr double kMedianOverMean = 1.2533;
  return values.size() < 2 ? 0
                           : kMedianOverMean * spread(values) / std::sqrt(static_cast<double>(values.size()));
}

std::vector<bool> outliers(const std::vector<double>& values) {
  constexpr std::size_t kFewest = 4;
  constexpr double kSpreads = 3.5;
  constexpr double kShare = 0.02;
  std::vector<bool> flags(values.size(), false);
  if (values.size() < kFewest) {
    return flags;
  }
  const double centre = median(values);
  const double limit = std::max(kSpreads * spread(values), kShare * std::abs(centre));
  for (std::size_t n = 0; n < values.size(); ++n) {
    flags[n] = std::abs(values[n] - centre) > limit;
  }
  return flags;
}

}  // namespace cbc3d::reports

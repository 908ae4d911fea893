#include "reports/statistics/holm.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace cbc3d::reports {

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const auto remaining = static_cast<double>(order.size() - n);
    largest = std::max(largest, std::min(1.0, remaining * p_values[order[n]]));
    adjusted[order[n]] = largest;
  }
  return adjusted;
}

}  // namespace cbc3d::reports

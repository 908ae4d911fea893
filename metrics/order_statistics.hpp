// Exact order statistics by nearest rank, in linear time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace cbc3d::metrics {

/// The value at per mille ranks, ascending: the smallest value that at least so many per mille of the values
/// do not exceed. Reorders the values. Nothing of no values. Expected time is linear.
template <class Value, std::size_t Ranks>
std::optional<std::array<double, Ranks>> order_statistics(std::span<Value> values,
                                                          const std::array<std::size_t, Ranks>& per_mille) {
  if (values.empty()) {
    return std::nullopt;
  }
  std::array<double, Ranks> result{};
  auto begin = values.begin();
  for (std::size_t r = 0; r < Ranks; ++r) {
    const std::size_t rank = std::max<std::size_t>((values.size() * per_mille[r] + 999) / 1000, 1) - 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(begin, at, values.end());
    result[r] = static_cast<double>(*at);
    begin = at;
  }
  return result;
}

/// The share of the values below a limit, percent; 0 of no values.
template <class Value>
double percent_below(std::span<const Value> values, double limit) {
  const auto below = std::count_if(values.begin(), values.end(),
                                   [limit](Value value) { return static_cast<double>(value) < limit; });
  return values.empty() ? 0 : 100 * static_cast<double>(below) / static_cast<double>(values.size());
}

}  // namespace cbc3d::metrics

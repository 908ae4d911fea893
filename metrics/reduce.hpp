// Sums and figures whose bytes do not depend on the thread count.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace cbc3d::metrics {

/// Loops over fewer items are not worth waking other threads.
inline constexpr std::size_t kWorthThreads = 2048;

/// Parallel sums over [0, count) into `slots` accumulators: `add(index, accumulators)` is called in ascending
/// order within blocks of fixed length, and the blocks are added up in order.
template <class Value, class Add>
std::vector<Value> ordered_sums(std::size_t count, std::size_t slots, const Add& add) {
  constexpr std::size_t kBlock = 16384;
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  std::vector<std::vector<Value>> partial(blocks);
#pragma omp parallel for schedule(dynamic) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<Value> mine(slots, Value{});
    for (std::size_t i = b * kBlock; i < std::min(count, (b + 1) * kBlock); ++i) {
      add(i, mine);
    }
    partial[b] = std::move(mine);
  }
  std::vector<Value> total(slots, Value{});
  for (const std::vector<Value>& block : partial) {
    for (std::size_t s = 0; s < slots; ++s) {
      total[s] += block[s];
    }
  }
  return total;
}

/// null for a figure that cannot be had.
inline nlohmann::json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

/// The larger of two figures, either of which may be missing.
inline std::optional<double> max_of(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) {
    return a ? a : b;
  }
  return std::max(*a, *b);
}

}  // namespace cbc3d::metrics

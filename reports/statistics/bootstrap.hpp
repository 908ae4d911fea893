// Intervals of medians by the bootstrap: B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap,
// Chapman & Hall 1993, chapter 13 (percentiles). Percentiles and not BCa, whose acceleration comes from the
// jackknife, which fails for medians (there, section 11.6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cbc3d::reports {

struct Interval {
  double low = 0;
  double high = 0;
  auto operator<=>(const Interval&) const = default;
};

/// The level of intervals in tables.
inline constexpr double kIntervalLevel = 0.95;
/// The seed of all resampling: the same values give the same interval.
inline constexpr std::uint64_t kBootstrapSeed = 20260101;

/// The fewest values that can have an interval of this level: the range of n values, which no bootstrap
/// leaves, holds the median with probability 1 - 2^(1-n). 6 for 95 %.
std::size_t fewest_for_interval(double level = kIntervalLevel);

/// Of the median. None with fewer values than fewest_for_interval.
std::optional<Interval> median_interval(const std::vector<double>& values, double level = kIntervalLevel,
                                        std::uint64_t seed = kBootstrapSeed);

/// Of the median of `values` over that of `reference`, each resampled by itself. None with fewer of either
/// than fewest_for_interval, or where a value of the reference is not above 0.
std::optional<Interval> median_ratio_interval(const std::vector<double>& values,
                                              const std::vector<double>& reference,
                                              double level = kIntervalLevel,
                                              std::uint64_t seed = kBootstrapSeed);

}  // namespace cbc3d::reports

#include "reports/statistics/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace cbc3d::reports {
namespace {

constexpr std::size_t kResamples = 4999;

/// Draws as many of the values, with replacement, and gives the median of what it drew.
class ResampledMedian {
 public:
  explicit ResampledMedian(const std::vector<double>& values) : values_(values), drawn_(values.size()) {}

  double operator()(std::mt19937_64& random) {
    std::uniform_int_distribution<std::size_t> draw(0, values_.size() - 1);
    for (double& value : drawn_) {
      value = values_[draw(random)];
    }
    const auto middle = drawn_.begin() + static_cast<std::ptrdiff_t>(drawn_.size() / 2);
    std::nth_element(drawn_.begin(), middle, drawn_.end());
    return drawn_.size() % 2 == 1 ? *middle : (*std::max_element(drawn_.begin(), middle) + *middle) / 2;
  }

 private:
  const std::vector<double>& values_;
  std::vector<double> drawn_;  ///< kept, for an allocation would take longer than the drawing
};

/// Percentiles of what `statistic()` gives when it is called often.
template <class Statistic>
Interval percentile_interval(double level, Statistic statistic) {
  std::vector<double> found(kResamples);
  for (double& value : found) {
    value = statistic();
  }
  std::sort(found.begin(), found.end());
  const double outside = (1 - level) / 2;
  const auto cut = static_cast<std::size_t>(std::floor(outside * static_cast<double>(kResamples + 1)));
  const std::size_t first = cut == 0 ? 0 : cut - 1;
  return {found[first], found[kResamples - 1 - first]};
}

}  // namespace

std::size_t fewest_for_interval(double level) {
  std::size_t count = 2;
  while (1 - std::exp2(1.0 - static_cast<double>(count)) < level) {
    ++count;
  }
  return count;
}

std::optional<Interval> median_interval(const std::vector<double>& values, double level, std::uint64_t seed) {
  if (values.size() < fewest_for_interval(level)) {
    return std::nullopt;
  }
  std::mt19937_64 random(seed);
  ResampledMedian resampled(values);
  return percentile_interval(level, [&] { return resampled(random); });
}

std::optional<Interval> median_ratio_interval(const std::vector<double>& values,
                                              const std::vector<double>& reference, double level,
                                              std::uint64_t seed) {
  const bool can_divide =
      std::all_of(reference.begin(), reference.end(), [](double value) { return value > 0; });
  if (std::min(values.size(), reference.size()) < fewest_for_interval(level) || !can_divide) {
    return std::nullopt;
  }
  std::mt19937_64 random(seed);
  ResampledMedian numerator(values), denominator(reference);
  return percentile_interval(level, [&] {
    const double above = numerator(random);
    return above / denominator(random);
  });
}

}  // namespace cbc3d::reports

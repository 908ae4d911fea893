// Samples against reference samples, several at once: how much larger, and whether that can be told from
// chance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/statistics/bootstrap.hpp"

namespace cbc3d::reports {

/// The level of what tables call faster or slower.
inline constexpr double kTableLevel = 0.05;

struct SamplePair {
  std::vector<double> sample, reference;
};

enum class Finding {
  larger,
  smaller,
  not_told_apart,
  too_few  ///< not even samples that do not overlap could be told apart, with so many values and tests
};

struct Comparison {
  std::optional<double> ratio;  ///< of the medians; none: a sample is empty, or it would divide by 0
  std::optional<Interval> ratio_interval;  ///< see median_ratio_interval
  double p = 1;                            ///< of the rank test
  double adjusted_p = 1;                   ///< after Holm's correction for all tests of the family
  double effect = 0.5;                     ///< A of Vargha and Delaney: above .5 the sample is larger
  Finding finding = Finding::too_few;
};

/// One family of tests: the findings hold together at `level`. Pairs with an empty sample count for nothing.
std::vector<Comparison> compare_samples(const std::vector<SamplePair>& pairs, double level);

/// What is found of times: "slower, A .98", "faster, A .03", "not told apart, A .62" or "too few runs to
/// tell".
std::string time_finding(const Comparison& comparison);

}  // namespace cbc3d::reports

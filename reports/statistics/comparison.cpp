#include "reports/statistics/comparison.hpp"

#include <algorithm>
#include <cstdio>

#include "reports/statistics/holm.hpp"
#include "reports/statistics/rank_test.hpp"
#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {
namespace {

bool has_values(const SamplePair& pair) {
  return !pair.sample.empty() && !pair.reference.empty();
}

Comparison compare(const SamplePair& pair) {
  Comparison comparison;
  if (!has_values(pair)) return comparison;
  const double base = median(pair.reference);
  if (base > 0) comparison.ratio = median(pair.sample) / base;
  comparison.ratio_interval = median_ratio_interval(pair.sample, pair.reference);
  comparison.p = mann_whitney_p(pair.sample, pair.reference);
  comparison.effect = vargha_delaney_a(pair.sample, pair.reference);
  return comparison;
}

/// `tests`: of the family.
Finding finding_of(const Comparison& comparison, const SamplePair& pair, std::size_t tests, double level) {
  if (comparison.adjusted_p <= level && comparison.effect != 0.5) {
    return comparison.effect > 0.5 ? Finding::larger : Finding::smaller;
  }
  const double least = smallest_mann_whitney_p(pair.sample.size(), pair.reference.size());
  return least * static_cast<double>(tests) > level ? Finding::too_few : Finding::not_told_apart;
}

}  // namespace

std::vector<Comparison> compare_samples(const std::vector<SamplePair>& pairs, double level) {
  std::vector<Comparison> comparisons;
  std::vector<double> p_values;
  for (const SamplePair& pair : pairs) {
    comparisons.push_back(compare(pair));
    if (has_values(pair)) p_values.push_back(comparisons.back().p);
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  std::size_t test = 0;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (has_values(pairs[n])) {
      comparisons[n].adjusted_p = adjusted[test++];
      comparisons[n].finding = finding_of(comparisons[n], pairs[n], adjusted.size(), level);
    }
  }
  return comparisons;
}

std::string time_finding(const Comparison& comparison) {
  if (comparison.finding == Finding::too_few) return "too few runs to tell";
  char effect[16];
  std::snprintf(effect, sizeof effect, "%.2f", comparison.effect);
  const char* words = comparison.finding == Finding::larger    ? "slower"
                      : comparison.finding == Finding::smaller ? "faster"
                                                               : "not told apart";
  return std::string(words) + ", A " + effect;
}

}  // namespace cbc3d::reports

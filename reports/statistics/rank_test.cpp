#include "reports/statistics/rank_test.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cbc3d::reports {
namespace {

/// Ranks of all values together, doubled, so that the mean rank of a tie is a whole number.
struct Ranks {
  std::vector<std::size_t> of_all;  ///< in increasing order
  std::size_t sum_of_first = 0;     ///< of the first sample
  double ties = 0;                  ///< sum of t^3 - t over groups of t equal values
};

struct Ranked {
  double value;
  bool is_first;
};

std::vector<Ranked> in_order(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<Ranked> all;
  all.reserve(a.size() + b.size());
  for (const double value : a) all.push_back({value, true});
  for (const double value : b) all.push_back({value, false});
  std::sort(all.begin(), all.end(), [](const Ranked& x, const Ranked& y) { return x.value < y.value; });
  return all;
}

Ranks ranks_of(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<Ranked> all = in_order(a, b);
  Ranks ranks;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].value == all[begin].value) ++end;
    const auto count = static_cast<double>(end - begin);
    ranks.ties += count * count * count - count;
    for (std::size_t n = begin; n < end; ++n) {
      ranks.of_all.push_back(begin + end + 1);
      ranks.sum_of_first += all[n].is_first ? begin + end + 1 : 0;
    }
  }
  return ranks;
}

/// How many choices of `count` of the ranks have each sum.
std::vector<double> choices_by_sum(const std::vector<std::size_t>& ranks, std::size_t count) {
  const std::size_t most = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::vector<std::vector<double>> choices(count + 1, std::vector<double>(most + 1, 0));
  choices[0][0] = 1;
  for (std::size_t taken = 0; taken < ranks.size(); ++taken) {
    const std::size_t rank = ranks[taken];
    for (std::size_t chosen = std::min(count, taken + 1); chosen > 0; --chosen) {
      for (std::size_t sum = rank; sum <= most; ++sum) {
        choices[chosen][sum] += choices[chosen - 1][sum - rank];
      }
    }
  }
  return choices[count];
}

double exact_p(const Ranks& ranks, std::size_t count) {
  const std::vector<double> choices = choices_by_sum(ranks.of_all, count);
  const auto at = choices.begin() + static_cast<std::ptrdiff_t>(ranks.sum_of_first);
  const double all = std::accumulate(choices.begin(), choices.end(), 0.0);
  const double below = std::accumulate(choices.begin(), at + 1, 0.0);
  const double above = std::accumulate(at, choices.end(), 0.0);
  return std::min(1.0, 2 * std::min(below, above) / all);
}

double normal_p(const Ranks& ranks, double count_a, double count_b) {
  const double all = count_a + count_b;
  const double u = static_cast<double>(ranks.sum_of_first) / 2 - count_a * (count_a + 1) / 2;
  const double variance = count_a * count_b / 12 * (all + 1 - ranks.ties / (all * (all - 1)));
  if (variance <= 0) return 1;
  const double distance = std::max(0.0, std::abs(u - count_a * count_b / 2) - 0.5);
  return std::erfc(distance / std::sqrt(2 * variance));
}

}  // namespace

double mann_whitney_normal_p(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 1;
  return normal_p(ranks_of(a, b), static_cast<double>(a.size()), static_cast<double>(b.size()));
}

double mann_whitney_p(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 1;
  return a.size() + b.size() > kExactUpTo ? mann_whitney_normal_p(a, b) : exact_p(ranks_of(a, b), a.size());
}

double smallest_mann_whitney_p(std::size_t count_a, std::size_t count_b) {
  double choices = 1;
  for (std::size_t n = 1; n <= count_a; ++n) {
    choices *= static_cast<double>(count_b + n) / static_cast<double>(n);
  }
  return std::min(1.0, 2 / choices);
}

double vargha_delaney_a(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 0.5;
  double larger = 0;
  for (const double x : a) {
    for (const double y : b) larger += x > y ? 1 : x == y ? 0.5 : 0;
  }
  return larger / (static_cast<double>(a.size()) * static_cast<double>(b.size()));
}

}  // namespace cbc3d::reports

#include "reports/history/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace cbc3d::reports {
namespace {

struct Split {
  std::size_t at = 0;  ///< values in front of it; 0: the segment is too short
  double q = 0;
};

/// Sum of |z - value| over the values.
double distances(double z, std::span<const double> values) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t n = 0; n < values.size(); ++n) {
    sum += std::abs(z - values[n]);
  }
  return sum;
}

double pairs(std::size_t count) {
  return static_cast<double>(count) * static_cast<double>(count - 1) / 2;
}

/// Where Q is the largest. Values move from Y to X one by one, and the three sums of distances follow.
Split best_split(std::span<const double> z) {
  Split best;
  double within_x = 0, within_y = 0, between = 0;
  for (std::size_t n = 1; n < z.size(); ++n) {
    within_y += distances(z[n], z.first(n));
  }
  for (std::size_t t = 1; t + kFewestValues <= z.size(); ++t) {
    const double to_x = distances(z[t - 1], z.first(t - 1));
    const double to_y = distances(z[t - 1], z.subspan(t));
    within_x += to_x;
    within_y -= to_y;
    between += to_y - to_x;
    if (t < kFewestValues) {
      continue;
    }
    const std::size_t m = z.size() - t;
    const auto product = static_cast<double>(t) * static_cast<double>(m);
    const double energy = 2 * between / product - within_x / pairs(t) - within_y / pairs(m);
    const double q = product / static_cast<double>(z.size()) * energy;
    if (best.at == 0 || q > best.q) {
      best = {t, q};
    }
  }
  return best;
}

/// Series cut at the change points that are known.
class Segments {
 public:
  explicit Segments(std::vector<double> values) : values_(std::move(values)), cuts_{0, values_.size()} {}

  /// The best split of all segments, counted from the first value of the series.
  [[nodiscard]] Split best() const {
    Split best;
    for (std::size_t s = 0; s + 1 < cuts_.size(); ++s) {
      const std::span<const double> all(values_);
      const Split split = best_split(all.subspan(cuts_[s], cuts_[s + 1] - cuts_[s]));
      if (split.at > 0 && (best.at == 0 || split.q > best.q)) {
        best = {cuts_[s] + split.at, split.q};
      }
    }
    return best;
  }

  void cut(std::size_t at) { cuts_.insert(std::upper_bound(cuts_.begin(), cuts_.end(), at), at); }

  /// Puts the values of every segment in another order, each as likely as any. The standard's shuffle differs
  /// from library to library.
  void shuffle(std::mt19937_64& random) {
    for (std::size_t s = 0; s + 1 < cuts_.size(); ++s) {
      for (std::size_t n = cuts_[s + 1] - 1; n > cuts_[s]; --n) {
        const std::size_t other = cuts_[s] + static_cast<std::size_t>(random() % (n - cuts_[s] + 1));
        std::swap(values_[n], values_[other]);
      }
    }
  }

 private:
  std::vector<double> values_;
  std::vector<std::size_t> cuts_;
};

/// Share of the permutations, the given order among them, whose statistic is as large as `q`. It ends early,
/// with a share above `level`, once no outcome of the others could bring it down to that.
double permutation_test(Segments segments, double q, double level, std::mt19937_64& random) {
  constexpr double kRounding = 1e-9;  // sums of the same values in another order
  const std::size_t count = permutation_count(level);
  std::size_t reached = 1;
  for (std::size_t n = 0; n < count; ++n) {
    segments.shuffle(random);
    reached += segments.best().q >= q * (1 - kRounding) ? 1 : 0;
    const double p = static_cast<double>(reached) / static_cast<double>(count + 1);
    if (p > level) {
      return p;
    }
  }
  return static_cast<double>(reached) / static_cast<double>(count + 1);
}

}  // namespace

std::size_t permutation_count(double level) {
  constexpr double kReached = 5;  // the given order and four others
  return static_cast<std::size_t>(std::ceil(kReached / level)) - 1;
}

std::vector<ChangePoint> find_change_points(const std::vector<double>& values,
                                            const ChangePointOptions& options) {
  std::vector<ChangePoint> found;
  Segments segments(values);
  std::mt19937_64 random(options.seed);
  while (true) {
    const Split split = segments.best();
    if (split.at == 0 || !(split.q > 0)) {
      break;
    }
    const double p = permutation_test(segments, split.q, options.level, random);
    if (p > options.level) {
      break;
    }
    found.push_back({split.at, p});
    segments.cut(split.at);
  }
  std::sort(found.begin(), found.end(),
            [](const ChangePoint& a, const ChangePoint& b) { return a.first_changed < b.first_changed; });
  return found;
}

}  // namespace cbc3d::reports

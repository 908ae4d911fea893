// Change points of a series by E-divisive means (Matteson and James 2014, "A nonparametric approach for
// multiple change point analysis of multivariate data", J. Am. Stat. Assoc. 109(505)), as they are used on
// benchmarks by MongoDB (Daly et al. 2020) and Hunter (Fleming et al. 2023).
//
// Notation: a segment z_1 ... z_N splits after t into X (n = t values) and Y (m = N - t values). With the
// energy distance of exponent 1, E = 2 mean |x - y| - mean |x - x'| - mean |y - y'|, means over pairs of
// different values, the statistic is Q(t) = n m / (n + m) E. The next change point is where Q is the largest
// over all segments, and it counts when a permutation test says so; then the segments are those on both
// sides of it. As MongoDB's, a segment splits in two, not in three.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cbc3d::reports {

struct ChangePointOptions {
  /// Probability that a series without a change point, whose values might as well stand in any other order,
  /// is given one.
  double level = 0.05;
  std::uint64_t seed = 1;  ///< of the permutations
};

struct ChangePoint {
  std::size_t first_changed = 0;  ///< number of the first value behind it
  double p = 1;                   ///< of the permutation test
};

/// Fewest values on either side of a change point: with one, nothing is known of how values spread there.
inline constexpr std::size_t kFewestValues = 2;

/// Permutations of a test at a level: so many that up to four of them may reach the statistic by chance and
/// the change point still counts. The least p is 1 / (permutations + 1).
std::size_t permutation_count(double level);

/// The change points in their order. Values are finite. The same values and options give the same points.
std::vector<ChangePoint> find_change_points(const std::vector<double>& values,
                                            const ChangePointOptions& options);

}  // namespace cbc3d::reports

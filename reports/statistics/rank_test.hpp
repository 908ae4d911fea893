// Whether one sample tends to be larger than another, by ranks alone: no outlier and no shape of the
// distribution counts.
#pragma once

#include <cstddef>
#include <vector>

namespace cbc3d::reports {

/// Values of both samples together up to which the test is exact.
inline constexpr std::size_t kExactUpTo = 50;

/// P of the two-sided test of H. B. Mann and D. R. Whitney, Ann. Math. Stat. 18 (1947): twice the smaller
/// tail, at most 1. Up to kExactUpTo values the tails are those of the permutations, given the ties, counted
/// by the shift algorithm (B. Streitberg, J. Roehmel, Statistical Software Newsletter 12, 1986); beyond, of
/// the normal distribution with corrections for ties and continuity (M. Hollander, D. A. Wolfe, Nonparametric
/// Statistical Methods, 1999, section 4.1). 1 when a sample is empty.
double mann_whitney_p(const std::vector<double>& a, const std::vector<double>& b);

/// The same by the normal distribution at any number.
double mann_whitney_normal_p(const std::vector<double>& a, const std::vector<double>& b);

/// The least p that samples of these sizes can have, without ties and with one of them above the other.
double smallest_mann_whitney_p(std::size_t count_a, std::size_t count_b);

/// The probability that a value of `a` is larger than one of `b`, ties counted half: A of A. Vargha and
/// H. D. Delaney, J. Educ. Behav. Stat. 25 (2000); by them .56 is a small effect, .64 a medium and .71 a
/// large one, as are .44, .36 and .29. .5 when a sample is empty.
double vargha_delaney_a(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace cbc3d::reports

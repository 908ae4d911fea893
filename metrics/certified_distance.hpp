// Directed Hausdorff distance with certified bounds.
#pragma once

#include <cstdint>
#include <vector>

#include "metrics/box_tree.hpp"
#include "metrics/surface_samples.hpp"

namespace cbc3d::metrics {

/// lower <= sup over a surface of the distance to another <= upper, up to rounding.
struct DistanceBounds {
  double lower_mm = 0, upper_mm = 0;
  bool operator==(const DistanceBounds&) const = default;
};

struct CertifyOptions {
  /// upper - lower, mm; > 0.
  double tolerance_mm = 0.01;
  /// Pieces looked at in one directed distance before the rest is left as it is. The bounds then are farther
  /// apart than the tolerance, and still hold.
  std::int64_t max_pieces = 20'000'000;
};

/// Bounds of the directed Hausdorff distance from `from` to the primitives of a tree, whose primitives are
/// convex and which is not empty. Branch and bound: a piece is cut in four while it may hold a point farther
/// than the farthest point known, by more than the tolerance. What may be is bounded by the distance of a
/// corner plus the piece's extent from there (the distance is 1-Lipschitz), and by the largest distance of a
/// corner to one and the same primitive (that is convex). `nearest` holds, for the points of `from`, what
/// tree.nearest says. Same bounds at any thread count. Instantiated for Triangle and AlignedBox.
template <class Primitive>
DistanceBounds certified_distance(const SampledSurface& from, const BoxTree<Primitive>& tree,
                                  const std::vector<typename BoxTree<Primitive>::Nearest>& nearest,
                                  const CertifyOptions& options);

}  // namespace cbc3d::metrics

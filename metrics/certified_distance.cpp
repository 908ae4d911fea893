#include "metrics/certified_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

// A corner of a piece: where, how far from the other surface and from which primitive of it.
struct Corner {
  Vec3 at;
  double distance;
  std::size_t nearest;
};
using Piece = std::array<Corner, 3>;

template <class Primitive>
class Refiner {
 public:
  // `budget`: pieces of one polygon that are looked at.
  Refiner(const BoxTree<Primitive>& tree, double tolerance_mm, std::int64_t budget)
      : tree_(tree), tolerance_mm_(tolerance_mm), budget_(budget) {}

  // Bounds over one polygon, of which only what exceeds known.lower_mm matters.
  DistanceBounds refine(const Polygon& polygon, std::size_t hint, DistanceBounds known) {
    known_ = known;
    pieces_ = 0;
    const Corner a = corner(polygon.p[0], hint);
    Corner last = corner(polygon.p[1], a.nearest);
    for (int n = 2; n < polygon.corners; ++n) {
      const Corner next = corner(polygon.p[static_cast<std::size_t>(n)], last.nearest);
      stack_.push_back({a, last, next});
      last = next;
    }
    while (!stack_.empty()) {
      const Piece piece = stack_.back();
      stack_.pop_back();
      examine(piece);
    }
    return known_;
  }
  // Pieces of the last polygon.
  [[nodiscard]] std::int64_t pieces() const { return pieces_; }

 private:
  Corner corner(const Vec3& at, std::size_t hint) {
    const auto nearest = tree_.nearest(at, hint);
    const double distance = std::sqrt(nearest.squared);
    known_.lower_mm = std::max(known_.lower_mm, distance);
    return {at, distance, nearest.index};
  }

  void examine(const Piece& piece) {
    ++pieces_;
    const double upper = upper_bound(piece);
    if (upper <= known_.lower_mm + tolerance_mm_ || pieces_ >= budget_) {
      known_.upper_mm = std::max(known_.upper_mm, upper);
      return;
    }
    const auto& [a, b, c] = piece;
    const Corner ab = corner(0.5 * (a.at + b.at), a.nearest);
    const Corner bc = corner(0.5 * (b.at + c.at), b.nearest);
    const Corner ca = corner(0.5 * (c.at + a.at), c.nearest);
    stack_.insert(stack_.end(), {Piece{a, ab, ca}, Piece{ab, b, bc}, Piece{ca, bc, c}, Piece{ab, bc, ca}});
  }

  [[nodiscard]] double upper_bound(const Piece& piece) const {
    double upper = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < 3; ++n) {
      const Corner &one = piece[n], &next = piece[(n + 1) % 3], &other = piece[(n + 2) % 3];
      const double extent =
          std::sqrt(std::max((next.at - one.at).squared_norm(), (other.at - one.at).squared_norm()));
      upper = std::min({upper, one.distance + extent, distance_to_one(piece, one)});
    }
    return upper;
  }

  // Largest distance of a corner to the primitive nearest to one of them.
  [[nodiscard]] double distance_to_one(const Piece& piece, const Corner& one) const {
    double largest = 0;
    for (const Corner& c : piece) {
      const double distance = c.nearest == one.nearest
                                  ? c.distance
                                  : std::sqrt(tree_.primitive(one.nearest).squared_distance(c.at));
      largest = std::max(largest, distance);
    }
    return largest;
  }

  const BoxTree<Primitive>& tree_;
  double tolerance_mm_;
  std::int64_t budget_, pieces_ = 0;
  DistanceBounds known_;
  std::vector<Piece> stack_;
};

double radius_of(const Polygon& polygon, const Vec3& centre) {
  double squared = 0;
  for (int n = 0; n < polygon.corners; ++n) {
    squared = std::max(squared, (polygon.p[static_cast<std::size_t>(n)] - centre).squared_norm());
  }
  return std::sqrt(squared);
}

struct Candidate {
  double upper_mm;
  std::size_t piece;
};

// Pieces that may hold a point beyond lower + tolerance, the most promising first; the rest raises `known`.
template <class Nearest>
std::vector<Candidate> find_candidates(const SampledSurface& from, const std::vector<Nearest>& nearest,
                                       double tolerance_mm, DistanceBounds& known) {
  std::vector<double> upper(from.pieces.size());
#pragma omp parallel for if (upper.size() > kWorthThreads)
  for (std::size_t n = 0; n < upper.size(); ++n) {
    upper[n] = std::sqrt(nearest[n].squared) + radius_of(from.pieces[n], from.points[n]);
  }
  std::vector<Candidate> candidates;
  for (std::size_t n = 0; n < upper.size(); ++n) {
    if (upper[n] > known.lower_mm + tolerance_mm) {
      candidates.push_back({upper[n], n});
    } else {
      known.upper_mm = std::max(known.upper_mm, upper[n]);
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.upper_mm > b.upper_mm || (a.upper_mm == b.upper_mm && a.piece < b.piece);
  });
  return candidates;
}

// Returns the number of pieces looked at, at most about `budget`.
template <class Primitive>
std::int64_t refine_batch(const SampledSurface& from, const BoxTree<Primitive>& tree,
                          const std::vector<typename BoxTree<Primitive>::Nearest>& nearest,
                          std::span<const Candidate> batch, double tolerance_mm, std::int64_t budget,
                          DistanceBounds& known) {
  const std::int64_t share = std::max<std::int64_t>(16, budget / static_cast<std::int64_t>(batch.size()));
  const DistanceBounds start = known;
  std::int64_t pieces = 0;
  double lower = start.lower_mm, upper = start.upper_mm;
#pragma omp parallel reduction(+ : pieces) reduction(max : lower, upper) if (batch.size() > 64)
  {
    Refiner<Primitive> refiner(tree, tolerance_mm, share);
#pragma omp for schedule(dynamic, 16)
    for (const auto& [bound, piece] : batch) {
      const DistanceBounds found = refiner.refine(from.pieces[piece], nearest[piece].index, start);
      lower = std::max(lower, found.lower_mm);
      upper = std::max(upper, found.upper_mm);
      pieces += refiner.pieces();
    }
  }
  known = {lower, upper};
  return pieces;
}

}  // namespace

template <class Primitive>
DistanceBounds certified_distance(const SampledSurface& from, const BoxTree<Primitive>& tree,
                                  const std::vector<typename BoxTree<Primitive>::Nearest>& nearest,
                                  const CertifyOptions& options) {
  DistanceBounds known;
  for (const auto& one : nearest) {
    known.lower_mm = std::max(known.lower_mm, std::sqrt(one.squared));
  }
  const std::vector<Candidate> candidates = find_candidates(from, nearest, options.tolerance_mm, known);
  std::int64_t left = options.max_pieces;
  // Batches, each against the lower bound at its beginning: what is cut does not depend on who is first.
  std::size_t begin = 0;
  for (std::size_t batch = 256; begin < candidates.size(); batch = std::min<std::size_t>(2 * batch, 65536)) {
    if (candidates[begin].upper_mm <= known.lower_mm + options.tolerance_mm || left <= 0) {
      break;
    }
    const std::size_t end = std::min(candidates.size(), begin + batch);
    left -= refine_batch(from, tree, nearest, std::span(candidates).subspan(begin, end - begin),
                         options.tolerance_mm, left, known);
    begin = end;
  }
  // Candidates are in descending order, so that the first one left bounds the rest.
  if (begin < candidates.size()) {
    known.upper_mm = std::max(known.upper_mm, candidates[begin].upper_mm);
  }
  known.upper_mm = std::max(known.upper_mm, known.lower_mm);
  return known;
}

template DistanceBounds certified_distance(const SampledSurface&, const BoxTree<Triangle>&,
                                           const std::vector<BoxTree<Triangle>::Nearest>&,
                                           const CertifyOptions&);
template DistanceBounds certified_distance(const SampledSurface&, const BoxTree<AlignedBox>&,
                                           const std::vector<BoxTree<AlignedBox>::Nearest>&,
                                           const CertifyOptions&);

}  // namespace cbc3d::metrics

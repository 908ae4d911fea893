#include "baselines/cleaver/alphas.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

namespace cbc3d::baselines::cleaver {
namespace {

// Two vertices may both move, so that each has less than half of the distance; the original keeps a fifth of
// that half as a distance between them.
constexpr double kSafeShare = 0.4;
// The lattice may be stretched by this much to fit an image, and still counts as regular.
constexpr double kStretch = 0.03;

using Corners = std::array<Vec3, 4>;

Corners corners_of(const Lattice& lattice, std::size_t tet) {
  Corners p;
  for (std::size_t n = 0; n < 4; ++n) p[n] = lattice.points[lattice.tets[tet][n]];
  return p;
}

// Two edges of one length without a common corner, and four of sqrt(3)/2 of it.
bool is_regular(const Corners& p) {
  std::array<double, 6> length{};
  double most = 0;
  for (std::size_t e = 0; e < 6; ++e) {
    length[e] = (p[kTetEdge[e][0]] - p[kTetEdge[e][1]]).norm();
    most = std::max(most, length[e]);
  }
  std::size_t long_edges = 0;
  for (std::size_t e = 0; e < 6; ++e) {
    const bool is_long = length[e] > (1 - kStretch) * most;
    const bool is_short = std::abs(length[e] - std::sqrt(0.75) * most) < kStretch * most;
    if (!is_long && !is_short) return false;
    if (is_long) {
      ++long_edges;
      if (length[5 - e] < (1 - kStretch) * most) return false;  // edge 5-e lies opposite edge e
    }
  }
  return long_edges == 2;
}

double least_width(const Corners& p) {
  const double volume = std::abs(six_volumes(p[0], p[1], p[2], p[3]));
  double least = std::numeric_limits<double>::infinity();
  for (const auto& face : kTetFace)
    least = std::min(least, volume / (p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]).norm());
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 a = p[kTetEdge[e][1]] - p[kTetEdge[e][0]];
    const Vec3 b = p[kTetEdge[5 - e][1]] - p[kTetEdge[5 - e][0]];
    least = std::min(least, volume / a.cross(b).norm());
  }
  return least;
}

// The least of several floats > 0 by their bits, which sort as they do.
void lower_to(std::uint32_t& least, float value) {
  const std::atomic_ref<std::uint32_t> shared(least);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  std::uint32_t seen = shared.load(std::memory_order_relaxed);
  while (bits < seen && !shared.compare_exchange_weak(seen, bits, std::memory_order_relaxed)) {
  }
}

struct VertexReach {
  std::vector<std::uint32_t> safe_mm;  // float bits: the way that a vertex may safely go
  std::vector<std::uint32_t> irregular;
  std::vector<std::uint32_t> least_edge, most_edge;
};

float as_float(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

VertexReach vertex_reach(const Lattice& lattice) {
  VertexReach reach;
  const auto infinity = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
  reach.safe_mm.assign(lattice.points.size(), infinity);
  reach.irregular.assign(lattice.points.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < lattice.tets.size(); ++t) {
    const Corners p = corners_of(lattice, t);
    const auto safe = static_cast<float>(kSafeShare * least_width(p));
    const bool regular = is_regular(p);
    for (const VertexId v : lattice.tets[t]) {
      lower_to(reach.safe_mm[v], safe);
      if (!regular) std::atomic_ref<std::uint32_t>(reach.irregular[v]).store(1, std::memory_order_relaxed);
    }
  }
  return reach;
}

}  // namespace

void set_alphas(CutLattice& cut) {
  const VertexReach reach = vertex_reach(cut.lattice);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < cut.cuts.size(); ++c) {
    Cut& edge = cut.cuts[c];
    const double length = (cut.lattice.points[edge.first] - cut.lattice.points[edge.second]).norm();
    const auto alpha = [&](VertexId v) {
      const double safe = as_float(reach.safe_mm[v]);
      if (reach.irregular[v] != 0) return safe / length;
      // The safe way of a regular vertex is a fifth of the long edge: 0.4 of the distance of the two long
      // ones.
      return length > 0.93 * safe / (0.5 * kSafeShare) ? kLongAlpha : kShortAlpha;
    };
    edge.alpha_first = static_cast<float>(alpha(edge.first));
    edge.alpha_second = static_cast<float>(alpha(edge.second));
  }
}

}  // namespace cbc3d::baselines::cleaver

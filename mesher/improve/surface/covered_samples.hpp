// Which interface points each vertex is host of, for steps that look at the whole mesh (SurfaceCover is that
// of a patch).
#pragma once

#include <algorithm>

#include "mesher/domain/interface_points.hpp"

namespace cbc3d {

class CoveredSamples {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// `hosts` has a vertex or kNoVertex for every point. Both must outlive this.
  CoveredSamples(const std::vector<InterfacePoint>& points, std::vector<VertexId>& hosts,
                 std::size_t vertices, double reach_mm)
      : points_(points), hosts_(hosts), reach_squared_(reach_mm * reach_mm), first_(vertices, kNone) {
    next_.assign(points.size(), kNone);
    for (std::uint32_t p = 0; p < hosts.size(); ++p) {
      if (hosts[p] != kNoVertex) {
        next_[p] = first_[hosts[p]];
        first_[hosts[p]] = p;
      }
    }
  }

  [[nodiscard]] const InterfacePoint& point(std::uint32_t p) const { return points_[p]; }
  [[nodiscard]] std::uint32_t first_of(VertexId v) const { return first_[v]; }
  [[nodiscard]] std::uint32_t next(std::uint32_t point) const { return next_[point]; }

  /// The largest squared distance at which a point may have a host: the reach, or where its host was, at
  /// `from`.
  [[nodiscard]] double limit_squared(std::uint32_t point, const Vec3& from) const {
    return std::max(reach_squared_, (from - points_[point].centre()).squared_norm());
  }

  /// True when v may go from a place to another: its points stay within reach, or come nearer.
  [[nodiscard]] bool allow(VertexId v, const Vec3& from, const Vec3& to) const {
    for (std::uint32_t p = first_[v]; p != kNone; p = next_[p]) {
      if ((to - points_[p].centre()).squared_norm() > limit_squared(p, from)) {
        return false;
      }
    }
    return true;
  }

  /// Gives a hosted point to another vertex.
  void move_point(std::uint32_t point, VertexId to) {
    std::uint32_t* link = &first_[hosts_[point]];
    while (*link != point) {
      link = &next_[*link];
    }
    *link = next_[point];
    next_[point] = first_[to];
    first_[to] = point;
    hosts_[point] = to;
  }

 private:
  const std::vector<InterfacePoint>& points_;
  std::vector<VertexId>& hosts_;
  double reach_squared_;
  std::vector<std::uint32_t> first_, next_;  // lists: of vertices into points, of points
};

}  // namespace cbc3d

// Which surface vertex stands for which boundary voxel: the guard that keeps every part of the image's
// boundary within a distance of the mesh's surface vertices while the mesh is thinned out.
//
// Points and hosts are those of interface_points.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/domain/interface_points.hpp"
#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

using PointId = std::uint32_t;
inline constexpr PointId kNoPoint = 0xFFFFFFFFU;

/// The hosts of some of the points, as lists at the vertices.
class SurfaceCover {
 public:
  /// `far_reach_mm`: points with a reach of their own have it there, 0 the others; may be empty.
  SurfaceCover(const std::vector<InterfacePoint>& points, double reach_mm,
               std::span<const float> far_reach_mm = {})
      : points_(&points), reach_mm_(reach_mm), far_reach_mm_(far_reach_mm) {}

  /// Makes room for vertices that have no points yet.
  void resize(std::size_t vertices) { first_.resize(vertices, kNoPoint); }
  void add(VertexId host, PointId point);

  /// True when every point of v finds a host once v is at `to` (or gone, when `to` is null): v itself or one
  /// of `others`, which are at their places in `mesh` and whose materials are `sets`. What has to change is
  /// remembered for commit.
  bool can_release(VertexId v, const Vec3* to, std::span<const VertexId> others, const TetComplex& mesh,
                   const std::vector<MaterialSet>& sets);
  /// Carries out what the last successful can_release found.
  void commit(VertexId v);

  /// Of two vertices that are to become one: finds the points that none of `others` (as in can_release) is
  /// host of, which the one vertex has to be near; false where no place is near them all. Remembered for
  /// commit_merge.
  bool find_stranded(VertexId u, VertexId v, std::span<const VertexId> others, const TetComplex& mesh,
                     const std::vector<MaterialSet>& sets);
  [[nodiscard]] const std::vector<PointId>& stranded() const { return stranded_; }
  /// What the last find_stranded found: v takes the stranded points, `others` the rest.
  void commit_merge(VertexId u, VertexId v);
  /// The largest distance at which a point may have its host.
  [[nodiscard]] double reach_mm(PointId point) const {
    return far_reach_mm_.empty() || far_reach_mm_[point] == 0 ? reach_mm_ : far_reach_mm_[point];
  }
  [[nodiscard]] double reach_squared(PointId point) const { return reach_mm(point) * reach_mm(point); }
  [[nodiscard]] Vec3 centre(PointId point) const { return (*points_)[point].centre(); }

  /// Calls f(point) for the points of a vertex.
  template <typename F>
  void for_each(VertexId v, const F& f) const {
    for (PointId p = first_[v]; p != kNoPoint; p = links_[p].next) {
      f(links_[p].point);
    }
  }

 private:
  struct Link {
    PointId point;
    PointId next;
  };
  [[nodiscard]] bool reaches(const Vec3& at, PointId point) const {
    return (centre(point) - at).squared_norm() <= reach_squared(point);
  }

  const std::vector<InterfacePoint>* points_;
  double reach_mm_;
  std::span<const float> far_reach_mm_;
  std::vector<PointId> first_;  // into links_, one a vertex
  std::vector<Link> links_;
  std::vector<PointId> stranded_;
  std::vector<VertexId> new_hosts_;  // of the links of the released vertex, in order; kNoVertex: stays
};

}  // namespace cbc3d

#include "mesher/improve/local/surface_cover.hpp"

#include <algorithm>
#include <limits>

namespace cbc3d {
namespace {

/// Where a vertex may be, along each axis, to reach some points.
struct BoxInReach {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{-kFar, -kFar, -kFar}, high{kFar, kFar, kFar};

  /// False when nothing is left.
  bool narrow(const Vec3& centre, double reach_mm) {
    bool left = true;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(low[axis], centre[axis] - reach_mm);
      high[axis] = std::min(high[axis], centre[axis] + reach_mm);
      left = left && low[axis] <= high[axis];
    }
    return left;
  }
};

}  // namespace

void SurfaceCover::add(VertexId host, PointId point) {
  links_.push_back({point, first_[host]});
  first_[host] = static_cast<PointId>(links_.size() - 1);
}

bool SurfaceCover::can_release(VertexId v, const Vec3* to, std::span<const VertexId> others,
                               const TetComplex& mesh, const std::vector<MaterialSet>& sets) {
  new_hosts_.clear();
  for (PointId link = first_[v]; link != kNoPoint; link = links_[link].next) {
    const PointId point = links_[link].point;
    if (to != nullptr && reaches(*to, point)) {
      new_hosts_.push_back(kNoVertex);
      continue;
    }
    const auto host = std::find_if(others.begin(), others.end(), [&](VertexId w) {
      return (*points_)[point].is_on(sets[w]) && reaches(mesh.point(w), point);
    });
    if (host == others.end()) {
      return false;
    }
    new_hosts_.push_back(*host);
  }
  return true;
}

bool SurfaceCover::find_stranded(VertexId u, VertexId v, std::span<const VertexId> others,
                                 const TetComplex& mesh, const std::vector<MaterialSet>& sets) {
  new_hosts_.clear();
  stranded_.clear();
  BoxInReach box;
  for (const VertexId from : {u, v}) {
    for (PointId link = first_[from]; link != kNoPoint; link = links_[link].next) {
      const PointId point = links_[link].point;
      const auto host = std::find_if(others.begin(), others.end(), [&](VertexId w) {
        return reaches(mesh.point(w), point) && (*points_)[point].is_on(sets[w]);
      });
      new_hosts_.push_back(host == others.end() ? v : *host);
      if (host == others.end()) {
        stranded_.push_back(point);
        if (!box.narrow(centre(point), reach_mm(point))) {
          return false;
        }
      }
    }
  }
  return true;
}

void SurfaceCover::commit_merge(VertexId u, VertexId v) {
  std::array<PointId, 2> chains = {first_[u], first_[v]};
  first_[u] = kNoPoint;
  first_[v] = kNoPoint;
  auto host = new_hosts_.begin();
  for (PointId link : chains) {
    while (link != kNoPoint) {
      const PointId next = links_[link].next;
      links_[link].next = first_[*host];
      first_[*host++] = link;
      link = next;
    }
  }
}

void SurfaceCover::commit(VertexId v) {
  PointId link = first_[v];
  first_[v] = kNoPoint;
  for (const VertexId host : new_hosts_) {
    const PointId next = links_[link].next;
    PointId& first = first_[host == kNoVertex ? v : host];
    links_[link].next = first;
    first = link;
    link = next;
  }
}

}  // namespace cbc3d

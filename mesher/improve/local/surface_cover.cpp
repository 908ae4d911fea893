#include "mesher/improve/local/surface_cover.hpp"

#include <algorithm>
#include <limits>

namespace cbc3d {
namespace {

/// Where a vertex may be, along each axis, to cover some samples.
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

SurfaceCover::SurfaceCover(const std::vector<BoundarySample>& samples, const std::vector<VertexId>& covering,
                           std::size_t vertices, double reach_mm)
    : SurfaceCover(samples, reach_mm) {
  resize(vertices);
  links_.reserve(covering.size());
  for (SampleId s = 0; s < covering.size(); ++s) {
    if (covering[s] != kNoVertex) {
      add(covering[s], s);
    }
  }
}

void SurfaceCover::add(VertexId vertex, SampleId sample) {
  links_.push_back({sample, first_[vertex]});
  first_[vertex] = static_cast<std::uint32_t>(links_.size() - 1);
}

double SurfaceCover::limit_squared(SampleId s, const Vec3& from) const {
  return std::max(reach_squared(s), (from - centre(s)).squared_norm());
}

bool SurfaceCover::may_move(VertexId v, const Vec3& from, const Vec3& to) const {
  return all_of(v, [&](SampleId s) { return (to - centre(s)).squared_norm() <= limit_squared(s, from); });
}

void SurfaceCover::reassign(SampleId sample, VertexId from, VertexId to) {
  std::uint32_t* link = &first_[from];
  while (links_[*link].sample != sample) {
    link = &links_[*link].next;
  }
  const std::uint32_t moved = *link;
  *link = links_[moved].next;
  links_[moved].next = first_[to];
  first_[to] = moved;
}

bool SurfaceCover::can_release(VertexId v, const Vec3* to, std::span<const VertexId> others,
                               const TetComplex& mesh, const std::vector<MaterialSet>& sets) {
  new_vertices_.clear();
  return all_of(v, [&](SampleId s) {
    if (to != nullptr && reaches(*to, s)) {
      new_vertices_.push_back(kNoVertex);
      return true;
    }
    const auto found = std::find_if(others.begin(), others.end(), [&](VertexId w) {
      return sample(s).is_on(sets[w]) && reaches(mesh.point(w), s);
    });
    if (found == others.end()) {
      return false;
    }
    new_vertices_.push_back(*found);
    return true;
  });
}

bool SurfaceCover::find_uncovered(VertexId u, VertexId v, std::span<const VertexId> others,
                                  const TetComplex& mesh, const std::vector<MaterialSet>& sets) {
  new_vertices_.clear();
  uncovered_.clear();
  BoxInReach box;
  const auto look_at = [&](SampleId s) {
    const auto found = std::find_if(others.begin(), others.end(), [&](VertexId w) {
      return reaches(mesh.point(w), s) && sample(s).is_on(sets[w]);
    });
    new_vertices_.push_back(found == others.end() ? v : *found);
    if (found != others.end()) {
      return true;
    }
    uncovered_.push_back(s);
    return box.narrow(centre(s), reach_mm(s));
  };
  return all_of(u, look_at) && all_of(v, look_at);
}

void SurfaceCover::commit_merge(VertexId u, VertexId v) {
  std::array<std::uint32_t, 2> chains = {first_[u], first_[v]};
  first_[u] = kNoSample;
  first_[v] = kNoSample;
  auto vertex = new_vertices_.begin();
  for (std::uint32_t link : chains) {
    while (link != kNoSample) {
      const std::uint32_t next = links_[link].next;
      links_[link].next = first_[*vertex];
      first_[*vertex++] = link;
      link = next;
    }
  }
}

void SurfaceCover::commit(VertexId v) {
  std::uint32_t link = first_[v];
  first_[v] = kNoSample;
  for (const VertexId vertex : new_vertices_) {
    const std::uint32_t next = links_[link].next;
    std::uint32_t& first = first_[vertex == kNoVertex ? v : vertex];
    links_[link].next = first;
    first = link;
    link = next;
  }
}

}  // namespace cbc3d

#include "mesher/improve/local/edge_split.hpp"

#include <algorithm>

#include "mesher/improve/local/star_quality.hpp"

namespace cbc3d {
namespace {

class EdgeSplitter {
 public:
  explicit EdgeSplitter(Patch& patch) : patch_(patch), mesh_(patch.mesh), ring_(patch.ring) {}

  bool try_tet(TetId t) {
    best_ = 0;
    const std::array<VertexId, 4> nodes = mesh_.nodes(t);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        consider(nodes[i], nodes[j]);
      }
    }
    return best_ > 0 && split();
  }

 private:
  /// Loads the ring of an edge that lies inside one material.
  bool load(VertexId a, VertexId b) {
    return (mesh_.free(a) || mesh_.free(b)) && mesh_.ring(a, b, ring_) && ring_.closed &&
           std::all_of(ring_.tets.begin(), ring_.tets.end(),
                       [&](TetId t) { return mesh_.material(t) == mesh_.material(ring_.tets[0]); });
  }

  void consider(VertexId a, VertexId b) {
    if (!load(a, b)) {
      return;
    }
    double before = 1;
    link_.clear();
    const std::size_t n = ring_.vertices.size();
    const Vec3& pa = mesh_.point(a);
    const Vec3& pb = mesh_.point(b);
    for (std::size_t i = 0; i < n; ++i) {
      before = std::min(before, mesh_.quality(ring_.tets[i]));
      const Vec3& r = mesh_.point(ring_.vertices[i]);
      const Vec3& s = mesh_.point(ring_.vertices[(i + 1) % n]);
      link_.push_back({pb, r, s});
      link_.push_back({pa, s, r});
    }
    Vec3 x = 0.5 * (pa + pb);
    const double after = optimize(x, (pb - pa).norm());
    if (after > std::max(0.0, before) && after > best_) {
      best_ = after;
      edge_ = {a, b};
      place_ = x;
    }
  }

  /// Moves x until no step lifts the worst angle; returns that angle.
  double optimize(Vec3& x, double h) const {
    double best = worst_quality(link_, x, -1e300);
    for (double length = 0.4 * h; length > 0.01 * h; length *= 0.6) {
      for (int turn = 0; turn < 3; ++turn) {
        const Vec3 from = x;
        for (const Vec3& direction : search_directions(steepest_ascent(link_, from, length))) {
          const Vec3 to = from + length * direction;
          const double after = worst_quality(link_, to, best);
          if (after > best) {
            best = after;
            x = to;
            break;
          }
        }
        if (x == from) {
          break;
        }
      }
    }
    return best;
  }

  bool split() {
    const auto [a, b] = edge_;
    load(a, b);
    const MaterialId material = mesh_.material(ring_.tets[0]);
    const VertexId middle = mesh_.add_vertex(place_);
    patch_.sets.emplace_back();
    patch_.cover.resize(mesh_.vertex_count());
    patch_.fresh.clear();
    const std::size_t n = ring_.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const VertexId r = ring_.vertices[i];
      const VertexId s = ring_.vertices[(i + 1) % n];
      patch_.fresh.push_back({{middle, b, r, s}, material});
      patch_.fresh.push_back({{middle, a, s, r}, material});
    }
    if (!mesh_.replace(ring_.tets, patch_.fresh)) {
      return false;
    }
    patch_.sets[middle].add(material);
    return true;
  }

  Patch& patch_;
  TetComplex& mesh_;
  EdgeRing& ring_;
  Link link_;
  std::pair<VertexId, VertexId> edge_;
  Vec3 place_;
  double best_ = 0;
};

}  // namespace

std::size_t split_edges(Patch& patch, double goal_quality) {
  EdgeSplitter splitter(patch);
  std::size_t split = 0;
  const auto slots = static_cast<TetId>(patch.mesh.tet_slots());
  for (TetId t = 0; t < slots; ++t) {
    if (patch.mesh.alive(t) && patch.mesh.quality(t) < goal_quality) {
      split += splitter.try_tet(t) ? 1 : 0;
    }
  }
  return split;
}

}  // namespace cbc3d

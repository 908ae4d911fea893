#include "mesher/improve/edge_collapse.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/tet_shape.hpp"

namespace cbc3d {
namespace {

/// A neighbour along an interface, with the number of facets at the edge to it.
struct SurfaceNeighbour {
  VertexId vertex;
  std::uint32_t facets;
};

void surface_neighbours(const std::vector<FacetAt>& facets, std::vector<SurfaceNeighbour>& neighbours) {
  neighbours.clear();
  for (const FacetAt& f : facets) {
    for (const VertexId w : {f.first, f.second}) {
      const auto found =
          std::find_if(neighbours.begin(), neighbours.end(), [&](const auto& s) { return s.vertex == w; });
      if (found == neighbours.end()) {
        neighbours.push_back({w, 1});
      } else {
        ++found->facets;
      }
    }
  }
}

std::uint32_t facets_to(const std::vector<SurfaceNeighbour>& neighbours, VertexId v) {
  const auto found =
      std::find_if(neighbours.begin(), neighbours.end(), [&](const auto& s) { return s.vertex == v; });
  return found == neighbours.end() ? 0 : found->facets;
}

class EdgeCollapser {
 public:
  EdgeCollapser(Patch& patch, const CollapseOptions& options)
      : patch_(patch), mesh_(patch.mesh), options_(options) {}

  bool try_vertex(VertexId u) {
    if (mesh_.locked(u) || !mesh_.in_use(u)) {
      return false;
    }
    mesh_.star(u, patch_.star);
    before_ = worst_of_star();
    if (options_.only_bad && before_ >= options_.threshold_sine_squared) {
      return false;
    }
    if (!find_class(u)) {
      return false;
    }
    rank_targets(u);
    for (const auto& [quality, v] : targets_) {
      if (keeps_shape(u, v) && (!on_facets_ || facets_allow(u, v))) {
        if (collapse(u, v)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] double worst_of_star() const {
    double worst = 1;
    for (const TetId t : patch_.star) {
      worst = std::min(worst, mesh_.sine_squared(t));
    }
    return worst;
  }

  /// Interior, on an interface, on a curve where interfaces meet; false for corners and where a surface is no
  /// manifold.
  bool find_class(VertexId u) {
    const MaterialSet& set = patch_.sets[u];
    on_facets_ = set.size > 1;
    on_curve_ = set.size > 2;
    if (set.overflow) {
      return false;
    }
    if (!on_facets_) {
      return true;
    }
    mesh_.facets(u, patch_.star, patch_.facets);
    surface_neighbours(patch_.facets, near_u_);
    const auto ends =
        std::count_if(near_u_.begin(), near_u_.end(), [](const auto& s) { return s.facets > 2; });
    const bool odd = std::any_of(near_u_.begin(), near_u_.end(), [](const auto& s) { return s.facets < 2; });
    return !odd && (on_curve_ ? ends == 2 : ends == 0 && is_one_fan());
  }

  /// True when the facets at the vertex follow each other once round it.
  [[nodiscard]] bool is_one_fan() const {
    const auto& facets = patch_.facets;
    VertexId at = facets.front().second;
    std::size_t steps = 1;
    for (std::size_t used = 0; at != facets.front().first && steps <= facets.size(); ++steps) {
      const auto next =
          std::find_if(facets.begin(), facets.end(), [&](const FacetAt& f) { return f.first == at; });
      if (next == facets.end()) {
        return false;
      }
      used = static_cast<std::size_t>(next - facets.begin());
      at = facets[used].second;
    }
    return steps == facets.size();
  }

  /// The neighbours that u may be drawn onto, best first.
  void rank_targets(VertexId u) {
    targets_.clear();
    mesh_.neighbours(u, patch_.star, patch_.around);
    double mean = 0;
    for (const VertexId w : patch_.around) {
      mean += (mesh_.point(w) - mesh_.point(u)).norm();
    }
    mean /= static_cast<double>(patch_.around.size());
    double longest = options_.longest_growth * mean;
    if (options_.longest_mm != nullptr) {
      for (const TetId t : patch_.star) {
        longest = std::min(longest, (*options_.longest_mm)[mesh_.material(t)]);
      }
    }
    const double floor = options_.only_bad ? before_ : options_.threshold_sine_squared;
    for (const VertexId v : patch_.around) {
      if (mesh_.locked(v) || !class_allows(v)) {
        continue;
      }
      const double quality = quality_onto(u, v, longest * longest, floor);
      if (quality > floor) {
        targets_.emplace_back(-quality, v);
      }
    }
    std::sort(targets_.begin(), targets_.end());
  }

  [[nodiscard]] bool class_allows(VertexId v) const {
    if (!on_facets_) {
      return true;
    }
    const std::uint32_t facets = facets_to(near_u_, v);
    return on_curve_ ? facets > 2 : facets == 2;
  }

  /// Worst angle of the tets that stay, with u at v; something not above `floor` where it is not better.
  [[nodiscard]] double quality_onto(VertexId u, VertexId v, double longest_squared, double floor) const {
    const Vec3& to = mesh_.point(v);
    double worst = 1;
    for (const TetId t : patch_.star) {
      if (mesh_.has_node(t, v)) {
        continue;
      }
      const auto& nodes = mesh_.nodes(t);
      const auto& face = kTetFace[mesh_.node_index(t, u)];
      const Vec3& p = mesh_.point(nodes[face[0]]);
      const Vec3& q = mesh_.point(nodes[face[1]]);
      const Vec3& r = mesh_.point(nodes[face[2]]);
      worst = std::min(worst, min_sine_squared(to, p, q, r));
      if (worst <= floor || std::max({(p - to).squared_norm(), (q - to).squared_norm(),
                                      (r - to).squared_norm()}) > longest_squared) {
        return -1;
      }
      if (options_.graded && !on_facets_ &&
          !grows_slowly(v, {nodes[face[0]], nodes[face[1]], nodes[face[2]]})) {
        return -1;
      }
    }
    return worst;
  }

  /// False when an edge from v to one of these would be longer than it may.
  [[nodiscard]] bool grows_slowly(VertexId v, const std::array<VertexId, 3>& ends) const {
    const std::vector<double>& longest = patch_.longest_mm;
    return std::all_of(ends.begin(), ends.end(), [&](VertexId w) {
      const double limit = 0.5 * (longest[v] + longest[w]);
      return (mesh_.point(v) - mesh_.point(w)).squared_norm() <= limit * limit;
    });
  }

  /// Link condition: what both ends are joined to is joined to the edge, and along interfaces by facets.
  bool keeps_shape(VertexId u, VertexId v) {
    mesh_.star(v, patch_.star_other);
    mesh_.neighbours(v, patch_.star_other, patch_.around_other);
    on_edge_.clear();
    for (const TetId t : patch_.star) {
      if (mesh_.has_node(t, v)) {
        for (const VertexId w : mesh_.nodes(t)) {
          if (w != u && w != v && std::find(on_edge_.begin(), on_edge_.end(), w) == on_edge_.end()) {
            on_edge_.push_back(w);
          }
        }
      }
    }
    for (const VertexId w : patch_.around_other) {
      if (w != u && std::find(patch_.around.begin(), patch_.around.end(), w) != patch_.around.end() &&
          std::find(on_edge_.begin(), on_edge_.end(), w) == on_edge_.end()) {
        return false;
      }
    }
    return !on_facets_ || keeps_surface_shape(v);
  }

  bool keeps_surface_shape(VertexId v) {
    mesh_.facets(v, patch_.star_other, patch_.facets_other);
    surface_neighbours(patch_.facets_other, near_v_);
    std::size_t common = 0;
    for (const SurfaceNeighbour& s : near_u_) {
      const std::uint32_t at_v = facets_to(near_v_, s.vertex);
      common += at_v > 0 ? 1 : 0;
      if (s.vertex != v && s.facets > 2 && at_v > 2) {
        return false;  // a curve of three edges would close up
      }
    }
    return common == facets_to(near_u_, v) && !shares_far_side();
  }

  /// True when two facets, one at each end, have the same far side: the pocket between them would close.
  [[nodiscard]] bool shares_far_side() const {
    return std::any_of(patch_.facets.begin(), patch_.facets.end(), [&](const FacetAt& f) {
      return std::any_of(patch_.facets_other.begin(), patch_.facets_other.end(), [&](const FacetAt& g) {
        return (f.first == g.first && f.second == g.second) || (f.first == g.second && f.second == g.first);
      });
    });
  }

  /// Boundary voxels, distance and folds.
  bool facets_allow(VertexId u, VertexId v) {
    hosts_.assign(1, v);
    for (const SurfaceNeighbour& s : near_u_) {
      if (s.vertex != v) {
        hosts_.push_back(s.vertex);
      }
    }
    if (!patch_.cover.can_release(u, nullptr, hosts_, mesh_, patch_.sets)) {
      return false;
    }
    const Vec3& from = mesh_.point(u);
    const Vec3& to = mesh_.point(v);
    for (const FacetAt& f : patch_.facets) {
      if (f.first == v || f.second == v) {
        continue;
      }
      const Vec3& p = mesh_.point(f.first);
      const Vec3& q = mesh_.point(f.second);
      const Vec3 old_normal = (p - from).cross(q - from);
      const Vec3 new_normal = (p - to).cross(q - to);
      if (!(old_normal.dot(new_normal) > 0.5 * old_normal.norm() * new_normal.norm())) {
        return false;
      }
    }
    return !strays(u, v);
  }

  /// True when a new facet lies farther from the boundary than allowed and than the old ones.
  bool strays(VertexId u, VertexId v) {
    const Vec3& from = mesh_.point(u);
    const Vec3& to = mesh_.point(v);
    double limit = -1;
    for (const FacetAt& f : patch_.facets) {
      if (f.first == v || f.second == v) {
        continue;
      }
      const double after =
          patch_.facet_deviation(to, mesh_.point(f.first), mesh_.point(f.second), f.inner, f.outer);
      if (after <= patch_.guards.deviation_mm) {
        continue;
      }
      if (limit < 0) {
        for (const FacetAt& g : patch_.facets) {
          limit = std::max(limit, patch_.facet_deviation(from, mesh_.point(g.first), mesh_.point(g.second),
                                                         g.inner, g.outer));
        }
      }
      if (after > limit) {
        return true;
      }
    }
    return false;
  }

  bool collapse(VertexId u, VertexId v) {
    patch_.fresh.clear();
    for (const TetId t : patch_.star) {
      if (!mesh_.has_node(t, v)) {
        std::array<VertexId, 4> nodes = mesh_.nodes(t);
        nodes[mesh_.node_index(t, u)] = v;
        patch_.fresh.push_back({nodes, mesh_.material(t)});
      }
    }
    const bool near_facets =
        on_facets_ || std::any_of(patch_.around.begin(), patch_.around.end(),
                                  [&](VertexId w) { return !mesh_.locked(w) && patch_.on_boundary(w); });
    if (!mesh_.replace(patch_.star, patch_.fresh)) {
      return false;
    }
    if (on_facets_) {
      patch_.cover.commit(u);
    }
    patch_.sets[u] = {};
    if (near_facets) {
      patch_.renew_sets(patch_.fresh);
    }
    return true;
  }

  Patch& patch_;
  TetComplex& mesh_;
  const CollapseOptions& options_;
  bool on_facets_ = false, on_curve_ = false;
  double before_ = 0;
  std::vector<SurfaceNeighbour> near_u_, near_v_;
  std::vector<std::pair<double, VertexId>> targets_;
  std::vector<VertexId> on_edge_, hosts_;
};

}  // namespace

std::size_t collapse_edges(Patch& patch, const CollapseOptions& options) {
  EdgeCollapser collapser(patch, options);
  std::size_t removed = 0;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    removed += collapser.try_vertex(v) ? 1 : 0;
  }
  return removed;
}

}  // namespace cbc3d

#include "mesher/improve/local/edge_collapse.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/local/local_volume_change.hpp"
#include "mesher/improve/local/surface_neighbours.hpp"
#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {
namespace {

class EdgeCollapser {
 public:
  EdgeCollapser(Patch& patch, const CollapseOptions& options)
      : patch_(patch), mesh_(patch.mesh), options_(options) {
    for (TetId t = 0; t < mesh_.tet_slots(); ++t) {
      tets_ += mesh_.alive(t) ? 1 : 0;
    }
  }

  [[nodiscard]] bool may_go_on() const { return tets_ > options_.least_tets; }

  bool try_vertex(VertexId u) {
    if (!mesh_.free(u) || !mesh_.in_use(u)) {
      return false;
    }
    mesh_.star(u, patch_.star);
    before_ = worst_of_star();
    if (options_.only_bad && before_ >= options_.threshold_quality) {
      return false;
    }
    if (!find_class(u)) {
      return false;
    }
    mesh_.neighbours(u, patch_.star, patch_.around);
    set_limits(u);
    return try_collapses(u) || (options_.optimize_position && try_merges(u));
  }

 private:
  [[nodiscard]] double worst_of_star() const {
    double worst = 1;
    for (const TetId t : patch_.star) {
      worst = std::min(worst, mesh_.quality(t));
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

  /// True when the facets at the vertex follow each other once around it.
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

  void set_limits(VertexId u) {
    floor_ = options_.only_bad ? before_ : options_.threshold_quality;
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
    if (on_facets_) {
      longest = std::min(longest, options_.longest_on_surface_mm);
      if (!patch_.longest_on_interface_mm.empty()) {
        longest = std::min(longest, patch_.longest_on_interface_mm[u]);
      }
    }
    longest_squared_ = longest * longest;
  }

  /// Collapses u onto a neighbour, if one allows it.
  bool try_collapses(VertexId u) {
    if (on_facets_ && !samples_stay_covered(u)) {
      return false;
    }
    rank_targets(u);
    return std::any_of(targets_.begin(), targets_.end(), [&](const auto& target) {
      const VertexId v = target.second;
      load_other(v);
      return keeps_topology(u, v) && (!on_facets_ || facets_allow(u, v)) && collapse(u, v);
    });
  }

  /// True when u could go and its samples stay covered.
  bool samples_stay_covered(VertexId u) {
    candidates_.clear();
    for (const SurfaceNeighbour& s : near_u_) {
      candidates_.push_back(s.vertex);
    }
    return patch_.cover.can_release(u, nullptr, candidates_, mesh_, patch_.sets);
  }

  /// The neighbours that u may collapse onto, best first.
  void rank_targets(VertexId u) {
    targets_.clear();
    for (const VertexId v : patch_.around) {
      if (mesh_.locked(v) || !class_allows(v)) {
        continue;
      }
      const double quality = quality_at(patch_.star, u, v, {v, mesh_.point(v)});
      if (quality > floor_) {
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

  /// A vertex and where it is to be.
  struct Placed {
    VertexId vertex;
    Vec3 at;
  };

  /// Worst angle of the tets of w that stay when those with `gone` vanish, with another vertex in the place
  /// of w; a value not above the floor where the angle is not above it.
  [[nodiscard]] double quality_at(std::span<const TetId> star, VertexId w, VertexId gone,
                                  const Placed& to) const {
    double worst = 1;
    const bool is_graded = options_.graded && !on_facets_;
    for (const TetId t : star) {
      if (mesh_.has_node(t, gone)) {
        continue;
      }
      const auto& nodes = mesh_.nodes(t);
      const auto& face = kTetFace[mesh_.node_index(t, w)];
      const Vec3& p = mesh_.point(nodes[face[0]]);
      const Vec3& q = mesh_.point(nodes[face[1]]);
      const Vec3& r = mesh_.point(nodes[face[2]]);
      // Lengths first: they cost less than the quality and refuse as many.
      if (std::max({(p - to.at).squared_norm(), (q - to.at).squared_norm(), (r - to.at).squared_norm()}) >
              longest_squared_ ||
          (is_graded && !grows_slowly(to, {nodes[face[0]], nodes[face[1]], nodes[face[2]]}))) {
        return -1;
      }
      worst = std::min(worst, tet_quality(to.at, p, q, r));
      if (worst <= floor_) {
        return -1;
      }
    }
    return worst;
  }

  /// False when an edge to one of these would be longer than the gradation allows.
  [[nodiscard]] bool grows_slowly(const Placed& from, const std::array<VertexId, 3>& ends) const {
    const std::vector<double>& longest = patch_.longest_mm;
    return std::all_of(ends.begin(), ends.end(), [&](VertexId w) {
      const double limit = 0.5 * (longest[from.vertex] + longest[w]);
      return (from.at - mesh_.point(w)).squared_norm() <= limit * limit;
    });
  }

  /// Loads the star of a neighbour, and what the neighbour is joined to along interfaces.
  void load_other(VertexId v) {
    mesh_.star(v, patch_.star_other);
    if (on_facets_) {
      mesh_.facets(v, patch_.star_other, patch_.facets_other);
      surface_neighbours(patch_.facets_other, near_v_);
    }
  }

  /// Link condition: what both ends are joined to is joined to the edge, and along interfaces by facets.
  bool keeps_topology(VertexId u, VertexId v) {
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
    return keeps_valence() && (!on_facets_ || keeps_surface_topology(v));
  }

  /// True when the one vertex that is left has no more edges than allowed, or than one of the two had. What
  /// both are joined to is known.
  [[nodiscard]] bool keeps_valence() const {
    const std::size_t u = patch_.around.size();
    const std::size_t v = patch_.around_other.size();
    return u + v - 2 - on_edge_.size() <= std::max({options_.largest_valence, u, v});
  }

  bool keeps_surface_topology(VertexId v) {
    std::size_t common = 0;
    for (const SurfaceNeighbour& s : near_u_) {
      const std::uint32_t at_v = facets_to(near_v_, s.vertex);
      common += at_v > 0 ? 1 : 0;
      if (s.vertex != v && s.facets > 2 && at_v > 2) {
        return false;  // a curve of three edges would close up
      }
    }
    return common == facets_to(near_u_, v) && !volumes_far_side();
  }

  /// True when two facets, one at each end, have the same far side: the pocket between them would close.
  [[nodiscard]] bool volumes_far_side() const {
    return std::any_of(patch_.facets.begin(), patch_.facets.end(), [&](const FacetAt& f) {
      return std::any_of(patch_.facets_other.begin(), patch_.facets_other.end(), [&](const FacetAt& g) {
        return (f.first == g.first && f.second == g.second) || (f.first == g.second && f.second == g.first);
      });
    });
  }

  /// Guards of the interface: folds, volumes and distance.
  bool facets_allow(VertexId u, VertexId v) {
    const Vec3& to = mesh_.point(v);
    return !folds(patch_.facets, mesh_.point(u), v, to) && keeps_volumes(u, v, to, false) &&
           !facets_deviate(u, v);
  }

  /// True when no material around u, and around v when both move, loses much of its volume there. Thin parts
  /// would be worn away otherwise, though their surfaces stay near the boundary.
  bool keeps_volumes(VertexId u, VertexId v, const Vec3& to, bool both_move) {
    volumes_.clear();
    volumes_.add_gains(mesh_, patch_.facets, {u, kNoVertex}, to);
    volumes_.add_volumes(mesh_, patch_.star, kNoVertex);
    if (both_move) {
      volumes_.add_gains(mesh_, patch_.facets_other, {v, u}, to);
      volumes_.add_volumes(mesh_, patch_.star_other, u);
    }
    return volumes_.largest_loss() <= options_.volume_share;
  }

  /// True when `holds(facet, p, q)` for a facet with sides to p and q that stays; those with `gone` vanish.
  template <typename Condition>
  [[nodiscard]] bool any_staying(const std::vector<FacetAt>& facets, VertexId gone,
                                 const Condition& holds) const {
    return std::any_of(facets.begin(), facets.end(), [&](const FacetAt& f) {
      return f.first != gone && f.second != gone && holds(f, mesh_.point(f.first), mesh_.point(f.second));
    });
  }

  /// True when a facet that stays turns too far while its vertex goes from one place to another.
  [[nodiscard]] bool folds(const std::vector<FacetAt>& facets, const Vec3& from, VertexId gone,
                           const Vec3& to) const {
    return any_staying(facets, gone, [&](const FacetAt&, const Vec3& p, const Vec3& q) {
      const Vec3 old_normal = (p - from).cross(q - from);
      const Vec3 new_normal = (p - to).cross(q - to);
      return !(old_normal.dot(new_normal) > 0.5 * old_normal.norm() * new_normal.norm());
    });
  }

  /// True when a new facet deviates or leans more from the boundary than allowed and than the old ones do.
  bool facets_deviate(VertexId u, VertexId v) {
    const Vec3& from = mesh_.point(u);
    const Vec3& to = mesh_.point(v);
    double limit = -1;
    return any_staying(patch_.facets, v, [&](const FacetAt& f, const Vec3& p, const Vec3& q) {
      const double after = patch_.facet_deviation(to, p, q, f.inner, f.outer);
      if (after > patch_.guards.deviation_mm && limit < 0) {
        limit = largest_deviation(from);
      }
      return (after > patch_.guards.deviation_mm && after > limit) || tilts(f, from, to);
    });
  }

  /// True when a facet whose vertex goes from one place to another leans farther from the boundary than
  /// allowed and than before.
  [[nodiscard]] bool tilts(const FacetAt& f, const Vec3& from, const Vec3& to) const {
    const Vec3& p = mesh_.point(f.first);
    const Vec3& q = mesh_.point(f.second);
    const double after = patch_.facet_cosine(to, p, q, f.inner, f.outer);
    return after < patch_.guards.least_cosine && after < patch_.facet_cosine(from, p, q, f.inner, f.outer);
  }

  [[nodiscard]] double largest_deviation(const Vec3& from) const {
    double largest = 0;
    for (const FacetAt& f : patch_.facets) {
      largest = std::max(largest, patch_.facet_deviation(from, mesh_.point(f.first), mesh_.point(f.second),
                                                         f.inner, f.outer));
    }
    return largest;
  }

  /// Merges u and a neighbour of the same class at a place between them.
  bool try_merges(VertexId u) {
    targets_.clear();
    for (const VertexId v : patch_.around) {
      if (mesh_.free(v) && class_allows(v) && has_class_of(u, v)) {
        targets_.emplace_back((mesh_.point(u) - mesh_.point(v)).squared_norm(), v);
      }
    }
    std::sort(targets_.begin(), targets_.end());
    return std::any_of(targets_.begin(), targets_.end(), [&](const auto& target) {
      return on_facets_ ? try_merge_on_facets(u, target.second) : try_merge_inside(u, target.second);
    });
  }

  [[nodiscard]] bool has_class_of(VertexId u, VertexId v) const {
    const MaterialSet& a = patch_.sets[u];
    const MaterialSet& b = patch_.sets[v];
    return !b.overflow && a.size == b.size &&
           std::equal(a.ids.begin(), a.ids.begin() + a.size, b.ids.begin());
  }

  bool try_merge_inside(VertexId u, VertexId v) {
    const Vec3 middle = 0.5 * (mesh_.point(u) + mesh_.point(v));
    if (quality_at(patch_.star, u, v, {v, middle}) <= floor_) {
      return false;
    }
    load_other(v);
    return quality_at(patch_.star_other, v, u, {v, middle}) > floor_ && keeps_topology(u, v) &&
           merge(u, {v, middle});
  }

  bool try_merge_on_facets(VertexId u, VertexId v) {
    load_other(v);
    const auto ends =
        std::count_if(near_v_.begin(), near_v_.end(), [](const auto& s) { return s.facets > 2; });
    if (ends != (on_curve_ ? 2 : 0)) {
      return false;
    }
    if (!find_uncovered_samples(u, v)) {
      return false;
    }
    merging_ = {u, v};
    for (const double share : {0.5, 1.0, 0.0}) {
      Placed to{v, mesh_.point(u) + share * (mesh_.point(v) - mesh_.point(u))};
      if (!find_place(to.at)) {
        return false;
      }
      if (merged_quality(u, to) > floor_ && merged_facets_allow(u, to)) {
        return keeps_topology(u, v) && merge(u, to);
      }
    }
    return false;
  }

  /// Finds the samples of u and v that no vertex around covers; false where no place is within the reach of
  /// all.
  bool find_uncovered_samples(VertexId u, VertexId v) {
    candidates_.clear();
    for (const auto* near : {&near_u_, &near_v_}) {
      for (const SurfaceNeighbour& s : *near) {
        if (s.vertex != u && s.vertex != v &&
            std::find(candidates_.begin(), candidates_.end(), s.vertex) == candidates_.end()) {
          candidates_.push_back(s.vertex);
        }
      }
    }
    if (!patch_.cover.find_uncovered(u, v, candidates_, mesh_, patch_.sets)) {
      return false;
    }
    pairs_.clear();
    for (const FacetAt& f : patch_.facets) {
      const std::array<MaterialId, 2> pair = {f.inner, f.outer};
      if (std::find(pairs_.begin(), pairs_.end(), pair) == pairs_.end()) {
        pairs_.push_back(pair);
      }
    }
    return true;
  }

  /// Projects a place by turns into the reach of the uncovered samples and onto the boundaries; false when
  /// that does not converge.
  bool find_place(Vec3& place) {
    constexpr int kTurns = 5;
    for (int turn = 0; turn < kTurns; ++turn) {
      if (!draw_into_reach(place)) {
        return false;
      }
      double deviation = 0;
      for (const auto& [inner, outer] : pairs_) {
        const BoundaryDistance near = patch_.boundaries.distance(place, inner, outer);
        if (!std::isfinite(near.deviation_mm)) {
          return false;
        }
        deviation = std::max(deviation, near.deviation_mm);
        place -= near.distance_mm * near.normal;
      }
      if (deviation <= patch_.guards.deviation_mm && farthest_uncovered(place).second <= 1) {
        keep_volume(place);
        return true;
      }
    }
    return false;
  }

  /// Shifts a place to where neither side of the one interface loses volume, if that is near and within the
  /// reach.
  void keep_volume(Vec3& place) const {
    if (pairs_.size() != 1) {
      return;
    }
    Vec3 area;
    double lost = 0;
    const auto add = [&](const std::vector<FacetAt>& facets, VertexId v, VertexId known) {
      for (const FacetAt& f : facets) {
        if (f.first != known && f.second != known) {
          const Vec3 a = mesh_.point(v) - place;
          const Vec3 b = mesh_.point(f.first) - place;
          const Vec3 c = mesh_.point(f.second) - place;
          lost += a.dot(b.cross(c));
          area += (b - a).cross(c - a);
        }
      }
    };
    add(patch_.facets, merging_[0], kNoVertex);
    add(patch_.facets_other, merging_[1], merging_[0]);
    const double squared = area.squared_norm();
    if (!(squared > 0) || lost * lost > patch_.guards.deviation_mm * patch_.guards.deviation_mm * squared) {
      return;
    }
    const Vec3 to = place + (lost / squared) * area;
    if (farthest_uncovered(to).second <= 1) {
      place = to;
    }
  }

  bool draw_into_reach(Vec3& place) const {
    constexpr int kSteps = 10;
    for (int step = 0; step < kSteps; ++step) {
      const auto& [sample, ratio] = farthest_uncovered(place);
      if (ratio <= 1) {
        return true;
      }
      const Vec3 centre = patch_.cover.centre(sample);
      place = centre + (0.98 / std::sqrt(ratio)) * (place - centre);
    }
    return false;
  }

  /// The uncovered sample that is farthest beyond its reach, and its squared distance as a multiple of the
  /// squared reach.
  [[nodiscard]] std::pair<SampleId, double> farthest_uncovered(const Vec3& place) const {
    std::pair<SampleId, double> farthest = {kNoSample, 0};
    for (const SampleId s : patch_.cover.uncovered()) {
      const double ratio = (patch_.cover.centre(s) - place).squared_norm() / patch_.cover.reach_squared(s);
      if (ratio > farthest.second) {
        farthest = {s, ratio};
      }
    }
    return farthest;
  }

  [[nodiscard]] double merged_quality(VertexId u, const Placed& to) const {
    const double quality = quality_at(patch_.star, u, to.vertex, to);
    return quality > floor_ ? std::min(quality, quality_at(patch_.star_other, to.vertex, u, to)) : quality;
  }

  [[nodiscard]] bool merged_facets_allow(VertexId u, const Placed& to) {
    const VertexId v = to.vertex;
    return !folds(patch_.facets, mesh_.point(u), v, to.at) &&
           !folds(patch_.facets_other, mesh_.point(v), u, to.at) && keeps_volumes(u, v, to.at, true) &&
           !facets_deviate(patch_.facets, mesh_.point(u), v, to.at) &&
           !facets_deviate(patch_.facets_other, mesh_.point(v), u, to.at);
  }

  /// True when a facet that stays deviates or leans more from the boundary than allowed and than before.
  [[nodiscard]] bool facets_deviate(const std::vector<FacetAt>& facets, const Vec3& from, VertexId gone,
                                    const Vec3& to) const {
    return any_staying(facets, gone, [&](const FacetAt& f, const Vec3& p, const Vec3& q) {
      const double after = patch_.facet_deviation(to, p, q, f.inner, f.outer);
      return (after > patch_.guards.deviation_mm &&
              after > patch_.facet_deviation(from, p, q, f.inner, f.outer)) ||
             tilts(f, from, to);
    });
  }

  bool merge(VertexId u, const Placed& to) {
    const VertexId v = to.vertex;
    const Vec3 before = mesh_.point(v);
    mesh_.move(v, to.at);
    if (!replace_vertex(u, v)) {
      mesh_.move(v, before);
      return false;
    }
    if (on_facets_) {
      patch_.cover.commit_merge(u, v);
    }
    return true;
  }

  bool collapse(VertexId u, VertexId v) {
    if (!replace_vertex(u, v)) {
      return false;
    }
    if (on_facets_) {
      patch_.cover.commit(u);
    }
    return true;
  }

  /// Replaces u by v in the tets of u; the tets of both vanish.
  bool replace_vertex(VertexId u, VertexId v) {
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
    tets_ -= patch_.star.size() - patch_.fresh.size();
    patch_.sets[u] = {};
    if (near_facets) {
      patch_.renew_sets(patch_.fresh);
    }
    return true;
  }

  Patch& patch_;
  TetComplex& mesh_;
  const CollapseOptions& options_;
  std::size_t tets_ = 0;  // of the patch, alive
  bool on_facets_ = false, on_curve_ = false;
  double before_ = 0;           // worst angle of the star
  double floor_ = 0;            // which angles have to be above
  double longest_squared_ = 0;  // of new edges
  std::vector<SurfaceNeighbour> near_u_, near_v_;
  std::vector<std::pair<double, VertexId>> targets_;
  std::vector<VertexId> on_edge_, candidates_;
  std::vector<std::array<MaterialId, 2>> pairs_;
  LocalVolumeChange volumes_;
  std::array<VertexId, 2> merging_{};
};

}  // namespace

std::size_t collapse_edges(Patch& patch, const CollapseOptions& options) {
  EdgeCollapser collapser(patch, options);
  std::size_t removed = 0;
  for (VertexId v = 0; v < patch.mesh.vertex_count() && collapser.may_go_on(); ++v) {
    removed += collapser.try_vertex(v) ? 1 : 0;
  }
  return removed;
}

}  // namespace cbc3d

#include "mesher/improve/surface/relabel_tets.hpp"

#include <algorithm>
#include <optional>

#include "mesher/improve/local/mesh_star.hpp"
#include "mesher/improve/surface/labelled_complex.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/topology_guard.hpp"

namespace cbc3d {
namespace {

using Facet = std::array<VertexId, 3>;

class Relabeller {
 public:
  Relabeller(MaterialMesh& mesh, SurfaceCover& cover, const Domain& domain, const RelabelOptions& options)
      : mesh_(mesh), complex_(mesh, domain.label_of()), cover_(cover), domain_(domain), options_(options) {}

  RelabelReport run() {
    for (int round = 0; round < options_.rounds; ++round) {
      const std::size_t before = report_.tets_relabelled + report_.vertices_moved;
      const std::size_t pinches = relabel_at_pinches();
      const std::size_t far = relabel_at_far_vertices();
      const std::size_t intersections = relabel_at_self_intersections();
      if (round == 0) {
        report_.pinches = pinches;
        report_.far_vertices = far;
        report_.self_intersections = intersections;
      }
      report_.defects_left = pinches + far + intersections;
      if (report_.tets_relabelled + report_.vertices_moved == before) {
        break;
      }
    }
    return report_;
  }

 private:
  /// At each pinch the smallest tet of the star that may is relabelled. Returns the number of pinches.
  std::size_t relabel_at_pinches() {
    std::vector<MaterialId> pinched(mesh_.points.size(), kBackground);
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t v = 0; v < pinched.size(); ++v) {
      const MaterialSet& set = complex_.set(static_cast<VertexId>(v));
      for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
        if (set.ids[i] != kBackground && !complex_.is_manifold_at(static_cast<VertexId>(v), set.ids[i])) {
          pinched[v] = set.ids[i];
        }
      }
    }
    std::size_t pinches = 0;
    for (VertexId v = 0; v < pinched.size(); ++v) {
      if (pinched[v] != kBackground) {
        ++pinches;
        relabel_at_pinch(v, pinched[v]);
      }
    }
    return pinches;
  }

  void relabel_at_pinch(VertexId v, MaterialId material) {
    std::vector<std::vector<TetId>> choices;
    for (const TetId t : complex_.star(v)) {
      if (domain_.label_of()[complex_.material(t)] == domain_.label_of()[material]) {
        choices.push_back({t});
      }
    }
    sort_by_volume(choices);
    std::any_of(choices.begin(), choices.end(),
                [this](const auto& tets) { return relabel_to_neighbour(tets); });
  }

  void sort_by_volume(std::vector<std::vector<TetId>>& choices) const {
    std::stable_sort(choices.begin(), choices.end(),
                     [this](const auto& a, const auto& b) { return volume(a) < volume(b); });
  }

  /// Each far vertex moves towards the boundary, or its tets of the label are relabelled. Returns their
  /// number.
  std::size_t relabel_at_far_vertices() {
    std::vector<std::uint8_t> far(mesh_.points.size(), 0);
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t v = 0; v < far.size(); ++v) {
      const MaterialSet& set = complex_.set(static_cast<VertexId>(v));
      for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
        far[v] |= static_cast<std::uint8_t>(!domain_.is_near_boundary(mesh_.points[v], set.ids[i]));
      }
    }
    std::size_t count = 0;
    for (VertexId v = 0; v < far.size(); ++v) {
      if (far[v] != 0) {
        ++count;
        relabel_at_far_vertex(v);
      }
    }
    return count;
  }

  void relabel_at_far_vertex(VertexId v) {
    const MaterialSet set = complex_.set(v);
    for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
      const MaterialId material = set.ids[i];
      if (material != kBackground && !domain_.is_near_boundary(mesh_.points[v], material)) {
        if (!step_towards_boundary(v, material)) {
          relabel_to_neighbour(tets_at(v, material));
        }
        return;
      }
    }
  }

  /// Moves v towards the boundary of a material until it is near, where no guard forbids it.
  bool step_towards_boundary(VertexId v, MaterialId material) {
    const Vec3 from = mesh_.points[v];
    const std::optional<Vec3> to = domain_.nearest_boundary(from, material);
    if (!to) {
      return false;
    }
    const double floor = std::min(options_.goal_quality, worst_at(v));
    const Vec3 step = (options_.step_mm / (*to - from).norm()) * (*to - from);
    for (const double share : {0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8}) {
      mesh_.points[v] = from + share * step;
      if (domain_.is_near_boundary(mesh_.points[v], material)) {
        if (worst_at(v) >= floor && is_near_all(v) && cover_.may_move(v, from, mesh_.points[v])) {
          ++report_.vertices_moved;
          return true;
        }
        break;
      }
    }
    mesh_.points[v] = from;
    return false;
  }

  [[nodiscard]] double worst_at(VertexId v) const {
    return worst_quality(mesh_, complex_.star(v));
  }

  [[nodiscard]] bool is_near_all(VertexId v) const {
    const MaterialSet& set = complex_.set(v);
    return std::all_of(set.ids.begin(), set.ids.begin() + set.size,
                       [&](MaterialId m) { return domain_.is_near_boundary(mesh_.points[v], m); });
  }

  /// Tets behind outer facets that intersect, or around one of these facets' vertices, become background, the
  /// smallest first. Returns the number of pairs.
  std::size_t relabel_at_self_intersections() {
    std::vector<Facet> facets;
    std::vector<TetId> behind;
    for (TetId t = 0; t < mesh_.tets.size(); ++t) {
      for (std::size_t n = 0; complex_.material(t) != kBackground && n < 4; ++n) {
        if (complex_.across(t, n) == kBackground) {
          const auto& face = kTetFace[n];
          facets.push_back({mesh_.tets[t][face[0]], mesh_.tets[t][face[1]], mesh_.tets[t][face[2]]});
          behind.push_back(t);
        }
      }
    }
    const auto pairs = intersecting_facets(mesh_.points, facets);
    for (const auto& [f, g] : pairs) {
      if (complex_.material(behind[f]) == kBackground || complex_.material(behind[g]) == kBackground) {
        continue;  // one of them has become background
      }
      std::vector<std::vector<TetId>> choices = {{behind[f]}, {behind[g]}};
      for (const std::uint32_t facet : {f, g}) {
        for (const VertexId v : facets[facet]) {
          choices.push_back(tets_at(v, complex_.material(behind[facet])));
        }
      }
      sort_by_volume(choices);
      for (const auto& choice : choices) {
        if (change(choice, kBackground)) {
          break;
        }
      }
    }
    return pairs.size();
  }

  [[nodiscard]] std::vector<TetId> tets_at(VertexId v, MaterialId material) const {
    std::vector<TetId> tets;
    for (const TetId t : complex_.star(v)) {
      if (complex_.material(t) == material) {
        tets.push_back(t);
      }
    }
    return tets;
  }

  [[nodiscard]] double volume(const std::vector<TetId>& tets) const {
    double sum = 0;
    for (const TetId t : tets) {
      const auto& n = mesh_.tets[t];
      sum += six_volumes(mesh_.points[n[0]], mesh_.points[n[1]], mesh_.points[n[2]], mesh_.points[n[3]]) / 6;
    }
    return sum;
  }

  /// Relabels tets of one material to what the domain has there, or else to a material next to them.
  bool relabel_to_neighbour(const std::vector<TetId>& tets) {
    MaterialSet takers;
    for (const TetId t : tets) {
      for (std::size_t n = 0; n < 4; ++n) {
        takers.add(complex_.across(t, n));
      }
    }
    Vec3 centre;
    for (const TetId t : tets) {
      for (const VertexId v : mesh_.tets[t]) {
        centre += (0.25 / static_cast<double>(tets.size())) * mesh_.points[v];
      }
    }
    const MaterialId meant = domain_.material_at(centre);
    if (takers.has(meant) && change(tets, meant)) {
      return true;
    }
    for (std::uint8_t i = 0; i < takers.size; ++i) {
      if (takers.ids[i] != meant && change(tets, takers.ids[i])) {
        return true;
      }
    }
    return false;
  }

  /// Gives tets of one material another where no guard forbids it.
  bool change(const std::vector<TetId>& tets, MaterialId to) {
    const MaterialId from = complex_.material(tets.front());
    if (from == to || from == kBackground || volume(tets) > options_.largest_mm3) {
      return false;
    }
    collect_vertices(tets);
    old_sets_.clear();
    pinched_.clear();
    for (const VertexId v : touched_) {
      old_sets_.push_back(complex_.set(v));
      pinched_.push_back(complex_.is_manifold_at(v, kBackground) ? 0 : 1);
    }
    const TopologyGuard topology(complex_, tets,
                                 options_.keep_topology ? std::vector{from, to} : std::vector<MaterialId>{});
    assign(tets, to);
    if (keeps_manifolds() && keeps_label(from) && keeps_near() && topology.holds() &&
        keeps_samples_covered()) {
      for (const Reassignment& r : new_covering_) {
        cover_.reassign(r.sample, r.from, r.to);
      }
      report_.tets_relabelled += tets.size();
      return true;
    }
    assign(tets, from);
    return false;
  }

  void collect_vertices(const std::vector<TetId>& tets) {
    touched_.clear();
    for (const TetId t : tets) {
      touched_.insert(touched_.end(), mesh_.tets[t].begin(), mesh_.tets[t].end());
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  }

  void assign(const std::vector<TetId>& tets, MaterialId material) {
    for (const TetId t : tets) {
      complex_.relabel(t, material);
    }
    for (const VertexId v : touched_) {
      complex_.renew_set(v);
    }
  }

  /// The surface of every label stays a manifold; that of all together may be pinched where it was.
  [[nodiscard]] bool keeps_manifolds() {
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      const MaterialSet set = complex_.set(touched_[i]);
      for (std::uint8_t s = 0; s < set.size; ++s) {
        const bool was_pinched = set.ids[s] == kBackground && pinched_[i] != 0;
        if (!was_pinched && !complex_.is_manifold_at(touched_[i], set.ids[s])) {
          return false;
        }
      }
      if (set.overflow) {
        return false;
      }
    }
    return true;
  }

  /// The label is still there beside the relabelled tets.
  [[nodiscard]] bool keeps_label(MaterialId material) const {
    return std::any_of(touched_.begin(), touched_.end(),
                       [&](VertexId v) { return complex_.set(v).has(material); });
  }

  /// A vertex that has come to a surface is near its boundary.
  [[nodiscard]] bool keeps_near() const {
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      const MaterialSet& set = complex_.set(touched_[i]);
      const MaterialSet& old = old_sets_[i];
      for (std::uint8_t s = 0; set.size > 1 && s < set.size; ++s) {
        const bool was_there = old.size > 1 && old.has(set.ids[s]);
        if (!was_there && !domain_.is_near_boundary(mesh_.points[touched_[i]], set.ids[s])) {
          return false;
        }
      }
    }
    return true;
  }

  /// Every sample is covered, by its old vertex or by one near it; the new ones are noted.
  [[nodiscard]] bool keeps_samples_covered() {
    new_covering_.clear();
    return std::all_of(touched_.begin(), touched_.end(), [&](VertexId v) {
      return cover_.all_of(v, [&](SampleId s) {
        if (cover_.sample(s).is_on(complex_.set(v))) {
          return true;
        }
        const VertexId to = covering_vertex_near(v, s);
        new_covering_.push_back({s, v, to});
        return to != kNoVertex;
      });
    });
  }

  /// The nearest vertex in two rings around v that covers a sample; kNoVertex for none.
  [[nodiscard]] VertexId covering_vertex_near(VertexId v, SampleId s) const {
    const Vec3 at = cover_.centre(s);
    double nearest = cover_.limit_squared(s, mesh_.points[v]);
    VertexId found = kNoVertex;
    for (const TetId t : complex_.star(v)) {
      for (const VertexId w : mesh_.tets[t]) {
        for (const TetId near : complex_.star(w)) {
          for (const VertexId x : mesh_.tets[near]) {
            const double d = (mesh_.points[x] - at).squared_norm();
            if (d < nearest && cover_.sample(s).is_on(complex_.set(x))) {
              nearest = d;
              found = x;
            }
          }
        }
      }
    }
    return found;
  }

  struct Reassignment {
    SampleId sample;
    VertexId from, to;
  };

  MaterialMesh& mesh_;
  LabelledComplex complex_;
  SurfaceCover& cover_;
  const Domain& domain_;
  const RelabelOptions& options_;
  RelabelReport report_;
  std::vector<VertexId> touched_;
  std::vector<MaterialSet> old_sets_;  // of the touched vertices
  std::vector<std::uint8_t> pinched_;  // likewise: the outer surface was non-manifold there
  std::vector<Reassignment> new_covering_;
};

}  // namespace

RelabelReport relabel_misplaced_tets(MaterialMesh& mesh, SurfaceCover& cover, const Domain& domain,
                                     const RelabelOptions& options) {
  const bool meshes_background =
      std::find(mesh.materials.begin(), mesh.materials.end(), kBackground) != mesh.materials.end();
  const RelabelReport report = Relabeller(mesh, cover, domain, options).run();
  if (report.tets_relabelled > 0 && !meshes_background) {
    remove_background(mesh);
  }
  return report;
}

}  // namespace cbc3d

#include "mesher/improve/local/edge_removal.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kLargestRing = 10;

/// The part of the ring that one material fills: ring vertices first ... last, counted on beyond the ring's
/// end.
struct Sector {
  std::size_t first, last;
  MaterialId material;
};

class EdgeRemover {
 public:
  explicit EdgeRemover(Patch& patch) : patch_(patch), mesh_(patch.mesh), ring_(patch.ring) {}

  /// Removes the edge where that lifts the worst angle of the tets around it.
  bool try_remove(VertexId a, VertexId b) {
    if (!load(a, b)) {
      return false;
    }
    const double before = worst_of_ring();
    return (sectors_.empty() || retriangulate(before)) && (!on_facets_ || facets_allow(false)) && commit();
  }

  /// Flips an edge of an interface where that makes the interface flatter and leaves no angle below the
  /// floor.
  bool try_flatten(VertexId a, VertexId b, double floor) {
    if (!load(a, b) || !on_facets_) {
      return false;
    }
    const double before = worst_of_ring();
    return (sectors_.empty() || retriangulate(std::min(before * 0.999, floor))) && facets_allow(true) &&
           commit();
  }

 private:
  [[nodiscard]] MaterialId ring_material(std::size_t i) const { return mesh_.material(ring_.tets[i]); }

  bool load(VertexId a, VertexId b) {
    if ((!mesh_.free(a) && !mesh_.free(b)) || !mesh_.ring(a, b, ring_) ||
        ring_.vertices.size() > kLargestRing) {
      return false;
    }
    a_ = a;
    b_ = b;
    return find_sectors();
  }

  [[nodiscard]] double worst_of_ring() const {
    double worst = 1;
    for (const TetId t : ring_.tets) {
      worst = std::min(worst, mesh_.quality(t));
    }
    return worst;
  }

  bool retriangulate(double floor) {
    patch_.fresh.clear();
    return std::all_of(sectors_.begin(), sectors_.end(),
                       [&](const Sector& sector) { return triangulate(sector, floor) > floor; });
  }

  bool commit() {
    if (sectors_.empty()) {
      patch_.fresh.clear();
    }
    if (!mesh_.replace(ring_.tets, patch_.fresh)) {
      return false;
    }
    if (on_facets_) {
      patch_.renew_sets_of(ring_.vertices);
      patch_.renew_sets_of(std::array{a_, b_});
    }
    return true;
  }

  /// Splits the ring at its facets; false where the edge must stay. A material with a single tet at the edge
  /// (an ear, with two faces on the interface) gives that tet up to the other material or to the outside.
  bool find_sectors() {
    sectors_.clear();
    ear_ = false;
    const std::size_t n = ring_.vertices.size();
    if (!ring_.closed) {
      on_facets_ = true;
      diagonal_ = {0, n - 1};
      ear_ = n == 2;
      if (!ear_) {
        sectors_.push_back({0, n - 1, ring_material(0)});
      }
      return std::all_of(ring_.tets.begin(), ring_.tets.end(),
                         [&](TetId t) { return mesh_.material(t) == ring_material(0); });
    }
    std::array<std::size_t, 2> facet{};
    std::size_t facets = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (ring_material(i) != ring_material((i + n - 1) % n)) {
        if (facets == 2) {
          return false;
        }
        facet[facets++] = i;
      }
    }
    on_facets_ = facets == 2;
    if (facets == 0) {
      sectors_.push_back({0, n - 1, ring_material(0)});
      return true;
    }
    diagonal_ = {facet[0], facet[1]};
    const std::size_t first = facet[1] - facet[0];
    ear_ = first == 1 || n - first == 1;
    if (first > 1) {
      sectors_.push_back({facet[0], facet[1], ring_material(facet[0])});
    }
    if (n - first > 1) {
      sectors_.push_back({facet[1], facet[0] + n, ring_material(facet[1])});
    }
    return true;
  }

  [[nodiscard]] VertexId vertex(std::size_t i) const { return ring_.vertices[i % ring_.vertices.size()]; }
  [[nodiscard]] const Vec3& at(std::size_t i) const { return mesh_.point(vertex(i)); }

  /// The best triangulation of a sector's polygon; its tets go to `fresh`. Returns the worst angle, or
  /// something not above `floor` when there is none better.
  double triangulate(const Sector& sector, double floor) {
    const std::size_t n = sector.last - sector.first + 1;
    for (std::size_t span = 2; span < n; ++span) {
      for (std::size_t i = 0; i + span < n; ++i) {
        fill(sector.first, i, i + span, floor);
      }
    }
    const double best = best_[0][n - 1];
    if (best > floor) {
      emit(sector, 0, n - 1);
    }
    return best;
  }

  void fill(std::size_t base, std::size_t i, std::size_t j, double floor) {
    best_[i][j] = -1;
    for (std::size_t k = i + 1; k < j; ++k) {
      double worst = std::min(k == i + 1 ? 1 : best_[i][k], k + 1 == j ? 1 : best_[k][j]);
      if (worst <= std::max(floor, best_[i][j])) {
        continue;
      }
      const Vec3& p = at(base + i);
      const Vec3& q = at(base + k);
      const Vec3& r = at(base + j);
      worst = std::min(worst, tet_quality(p, q, r, mesh_.point(b_)));
      if (worst > std::max(floor, best_[i][j])) {
        worst = std::min(worst, tet_quality(p, r, q, mesh_.point(a_)));
      }
      if (worst > best_[i][j]) {
        best_[i][j] = worst;
        middle_[i][j] = k;
      }
    }
  }

  void emit(const Sector& sector, std::size_t i, std::size_t j) {
    if (j < i + 2) {
      return;
    }
    const std::size_t k = middle_[i][j];
    const VertexId p = vertex(sector.first + i);
    const VertexId q = vertex(sector.first + k);
    const VertexId r = vertex(sector.first + j);
    patch_.fresh.push_back({{p, q, r, b_}, sector.material});
    patch_.fresh.push_back({{p, r, q, a_}, sector.material});
    emit(sector, i, k);
    emit(sector, k, j);
  }

  /// A flip of an interface must keep a manifold and the classes of its vertices, stay near the boundary, and
  /// not fold the interface; when it must `flatten`, the interface must become clearly flatter.
  bool facets_allow(bool flatten) {
    const VertexId p = vertex(diagonal_[0]);
    const VertexId q = vertex(diagonal_[1]);
    if (mesh_.locked(a_) || mesh_.locked(b_) || mesh_.locked(p) || mesh_.locked(q)) {
      return false;
    }
    const Vec3& pa = mesh_.point(a_);
    const Vec3& pb = mesh_.point(b_);
    const Vec3& pp = mesh_.point(p);
    const Vec3& pq = mesh_.point(q);
    const double old_fold = fold_cosine(pa, pb, pp, pq);
    const double new_fold = fold_cosine(pp, pq, pb, pa);
    if (flatten ? new_fold < old_fold + 0.1 : new_fold < std::min(0.5, old_fold)) {
      return false;
    }
    if ((ear_ ? on_interface(p, q) : joined(p, q)) || facets_at(a_) < 4 || facets_at(b_) < 4) {
      return false;
    }
    const auto [inner, outer] = parted_materials();
    const double after = std::max(patch_.facet_deviation(pa, pp, pq, inner, outer),
                                  patch_.facet_deviation(pb, pp, pq, inner, outer));
    if (after <= patch_.guards.deviation_mm) {
      return true;
    }
    return after <= std::max(patch_.facet_deviation(pa, pb, pp, inner, outer),
                             patch_.facet_deviation(pa, pb, pq, inner, outer));
  }

  [[nodiscard]] std::pair<MaterialId, MaterialId> parted_materials() const {
    const MaterialId m = ring_material(0);
    MaterialId other = kBackground;
    for (const TetId t : ring_.tets) {
      other = mesh_.material(t) != m ? mesh_.material(t) : other;
    }
    return {std::max(m, other), std::min(m, other)};
  }

  /// Cosine of the angle between the normals of triangles (e, f, g) and (f, e, h): 1 when they are flat.
  static double fold_cosine(const Vec3& e, const Vec3& f, const Vec3& g, const Vec3& h) {
    const Vec3 n = (f - e).cross(g - e);
    const Vec3 m = (e - f).cross(h - f);
    const double lengths = std::sqrt(n.squared_norm() * m.squared_norm());
    return lengths > 0 ? n.dot(m) / lengths : -1;
  }

  /// True when an edge lies on some interface or on the outside.
  [[nodiscard]] bool on_interface(VertexId p, VertexId q) {
    EdgeRing& ring = patch_.ring_other;
    return !mesh_.ring(p, q, ring) || !ring.closed ||
           std::any_of(ring.tets.begin(), ring.tets.end(),
                       [&](TetId t) { return mesh_.material(t) != mesh_.material(ring.tets[0]); });
  }

  [[nodiscard]] bool joined(VertexId p, VertexId q) {
    mesh_.star(p, patch_.star_other);
    return std::any_of(patch_.star_other.begin(), patch_.star_other.end(),
                       [&](TetId t) { return mesh_.has_node(t, q); });
  }
  [[nodiscard]] std::size_t facets_at(VertexId v) {
    mesh_.star(v, patch_.star_other);
    mesh_.facets(v, patch_.star_other, patch_.facets_other);
    return patch_.facets_other.size();
  }

  Patch& patch_;
  TetComplex& mesh_;
  EdgeRing& ring_;
  VertexId a_ = 0, b_ = 0;
  std::vector<Sector> sectors_;
  std::array<std::size_t, 2> diagonal_{};
  bool on_facets_ = false, ear_ = false;
  std::array<std::array<double, kLargestRing>, kLargestRing> best_{};
  std::array<std::array<std::size_t, kLargestRing>, kLargestRing> middle_{};
};

}  // namespace

std::size_t flatten_interfaces(Patch& patch, double floor_quality) {
  EdgeRemover remover(patch);
  std::size_t flipped = 0;
  std::vector<FacetAt> facets;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    if (patch.mesh.locked(v) || !patch.mesh.in_use(v) || patch.sets[v].size != 2) {
      continue;
    }
    patch.mesh.star(v, patch.star);
    patch.mesh.facets(v, patch.star, facets);
    for (const FacetAt& f : facets) {
      if (f.first > v && remover.try_flatten(v, f.first, floor_quality)) {
        ++flipped;
        break;
      }
    }
  }
  return flipped;
}

std::size_t remove_edges(Patch& patch, double goal_quality) {
  EdgeRemover remover(patch);
  std::size_t removed = 0;
  const auto slots = static_cast<TetId>(patch.mesh.tet_slots());
  for (TetId t = 0; t < slots; ++t) {
    if (!patch.mesh.alive(t) || patch.mesh.quality(t) >= goal_quality) {
      continue;
    }
    const auto nodes = patch.mesh.nodes(t);
    bool gone = false;
    for (std::size_t i = 0; i < 4 && !gone; ++i) {
      for (std::size_t j = i + 1; j < 4 && !gone; ++j) {
        gone = remover.try_remove(nodes[i], nodes[j]);
      }
    }
    removed += gone ? 1 : 0;
  }
  return removed;
}

}  // namespace cbc3d

#include "mesher/quadratic/curved_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesher/quadratic/tet_jacobian.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

// A node that would fold a tet is halved so often before it stays in the middle.
constexpr int kMostHalvings = 3;

/// The two materials that meet along an edge; a third makes it a junction.
struct EdgeMaterials {
  MaterialId lower = 0, higher = 0;
  bool on_boundary = false, is_junction = false;

  void meet(MaterialId a, MaterialId b) {
    is_junction |= on_boundary && (a != lower || b != higher);
    lower = a;
    higher = b;
    on_boundary = true;
  }
};

class Curver {
 public:
  Curver(const MaterialMesh& mesh, const ImageDomain& domain, const CurveOptions& options)
      : mesh_(mesh),
        domain_(domain),
        options_(options),
        quadratic_(straight_quadratic_mesh(to_physical_mesh(mesh, domain.image()))) {}

  QuadraticMesh run(CurveReport& report) {
    find_boundary_edges();
    find_moves();
    place_nodes();
    const std::vector<std::size_t> tets = tets_with_moves();
    while (hold_back(tets)) {
    }
    describe(tets, report);
    return std::move(quadratic_);
  }

 private:
  [[nodiscard]] std::size_t edge_count() const { return quadratic_.edges.size(); }

  [[nodiscard]] std::size_t number_of(VertexId a, VertexId b) const {
    const std::array<VertexId, 2> edge{std::min(a, b), std::max(a, b)};
    return static_cast<std::size_t>(std::lower_bound(quadratic_.edges.begin(), quadratic_.edges.end(), edge) -
                                    quadratic_.edges.begin());
  }

  void find_boundary_edges() {
    materials_.resize(edge_count());
    for (const InterfaceFacet& facet : interface_facets(mesh_, cells_of_vertices(mesh_))) {
      for (std::size_t n = 0; n < 3; ++n) {
        materials_[number_of(facet.nodes[n], facet.nodes[(n + 1) % 3])].meet(facet.lower, facet.higher);
      }
    }
  }

  /// Moves in local mm; zero where there is none.
  void find_moves() {
    moves_.resize(edge_count());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t e = 0; e < edge_count(); ++e) {
      if (materials_[e].on_boundary && !materials_[e].is_junction) moves_[e] = move_of(e);
    }
  }

  [[nodiscard]] Vec3 move_of(std::size_t e) const {
    constexpr int kSteps = 4;
    const auto [a, b] = quadratic_.edges[e];
    const Vec3 middle = 0.5 * (mesh_.points[a] + mesh_.points[b]);
    const BoundaryDistance at_a = distance(mesh_.points[a], e), at_b = distance(mesh_.points[b], e);
    if (!at_a.is_close || !at_b.is_close) return {};
    const double wanted_mm = 0.5 * (at_a.distance_mm + at_b.distance_mm);
    const double most_mm = options_.greatest_move * (mesh_.points[a] - mesh_.points[b]).norm();
    Vec3 at = middle;
    double before_mm = 0, after_mm = 0;
    for (int step = 0; step <= kSteps; ++step) {
      const BoundaryDistance here = distance(at, e);
      if (!here.is_close) return {};
      after_mm = std::fabs(here.distance_mm - wanted_mm);
      if (step == 0) before_mm = after_mm;
      if (step < kSteps) at += (wanted_mm - here.distance_mm) * here.normal;
      if ((at - middle).norm() > most_mm) return {};
    }
    return after_mm < before_mm ? at - middle : Vec3{};
  }

  [[nodiscard]] BoundaryDistance distance(const Vec3& at, std::size_t e) const {
    return domain_.boundary_distance(at, materials_[e].lower, materials_[e].higher);
  }

  void place_nodes() {
    halvings_.assign(edge_count(), 0);
    for (std::size_t e = 0; e < edge_count(); ++e) place_node(e);
  }

  void place_node(std::size_t e) {
    const auto [a, b] = quadratic_.edges[e];
    const double share = halvings_[e] >= kMostHalvings ? 0 : std::ldexp(1.0, -halvings_[e]);
    quadratic_.points[quadratic_.corners + e] = 0.5 * (quadratic_.points[a] + quadratic_.points[b]) +
                                                share * (domain_.image().frame.direction * moves_[e]);
  }

  [[nodiscard]] bool is_moved(std::size_t e) const {
    return halvings_[e] < kMostHalvings && moves_[e].squared_norm() > 0;
  }

  [[nodiscard]] std::vector<std::size_t> tets_with_moves() const {
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < quadratic_.tets.size(); ++t) {
      const auto& nodes = quadratic_.tets.nodes[t];
      if (std::any_of(nodes.begin() + 4, nodes.end(),
                      [&](VertexId v) { return is_moved(v - quadratic_.corners); })) {
        found.push_back(t);
      }
    }
    return found;
  }

  [[nodiscard]] double jacobian_of(std::size_t t) const {
    std::array<Vec3, 10> places;
    for (std::size_t n = 0; n < 10; ++n) places[n] = quadratic_.points[quadratic_.tets.nodes[t][n]];
    return least_relative_jacobian(places);
  }

  /// Halves all moves of every tet whose Jacobian is too small. False when there was none.
  bool hold_back(const std::vector<std::size_t>& tets) {
    std::vector<std::uint8_t> suffers(tets.size());
#pragma omp parallel for schedule(static)
    for (std::size_t n = 0; n < tets.size(); ++n)
      suffers[n] = jacobian_of(tets[n]) < options_.least_jacobian ? 1 : 0;
    std::vector<std::size_t> edges;
    for (std::size_t n = 0; n < tets.size(); ++n) {
      for (std::size_t k = 4; suffers[n] != 0 && k < 10; ++k) {
        const std::size_t e = quadratic_.tets.nodes[tets[n]][k] - quadratic_.corners;
        if (is_moved(e)) edges.push_back(e);
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const std::size_t e : edges) {
      ++halvings_[e];
      place_node(e);
    }
    return !edges.empty();
  }

  void describe(const std::vector<std::size_t>& tets, CurveReport& report) const {
    report = {};
    for (std::size_t e = 0; e < edge_count(); ++e) {
      const bool had_move = moves_[e].squared_norm() > 0;
      report.boundary_edges += materials_[e].on_boundary ? 1 : 0;
      report.curved += is_moved(e) ? 1 : 0;
      report.held_back += is_moved(e) && halvings_[e] > 0 ? 1 : 0;
      report.straight += had_move && !is_moved(e) ? 1 : 0;
    }
    for (const std::size_t t : tets) report.least_jacobian = std::min(report.least_jacobian, jacobian_of(t));
  }

  const MaterialMesh& mesh_;
  const ImageDomain& domain_;
  const CurveOptions& options_;
  QuadraticMesh quadratic_;
  std::vector<EdgeMaterials> materials_;
  std::vector<Vec3> moves_;
  std::vector<int> halvings_;
};

}  // namespace

QuadraticMesh curved_quadratic_mesh(const MaterialMesh& mesh, const ImageDomain& domain,
                                    const CurveOptions& options, CurveReport& report) {
  return Curver(mesh, domain, options).run(report);
}

}  // namespace cbc3d

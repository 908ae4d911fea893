#include "mesher/quadratic/curved_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mesher/quadratic/node_offsets.hpp"
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

/// How an edge's node can leave the middle; where it cannot, both are zero.
struct NodeMove {
  Vec3 to_boundary_mm;  ///< local
  Vec3 outwards;        ///< unit, away from the lower material
};

class Curver {
 public:
  Curver(const MaterialMesh& mesh, const ImageDomain& domain, const CurveOptions& options)
      : mesh_(mesh),
        domain_(domain),
        options_(options),
        offsets_(domain),
        quadratic_(straight_quadratic_mesh(to_physical_mesh(mesh, domain.image()))) {}

  QuadraticMesh run(CurveReport& report) {
    facets_ = interface_facets(mesh_, cells_of_vertices(mesh_));
    find_boundary_edges();
    find_moves();
    halvings_.assign(edge_count(), 0);
    place_nodes();
    tets_ = tets_with_nodes_that_move();
    settle_volumes();
    describe(report);
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
    for (const InterfaceFacet& facet : facets_) {
      for (std::size_t n = 0; n < 3; ++n) {
        materials_[number_of(facet.nodes[n], facet.nodes[(n + 1) % 3])].meet(facet.lower, facet.higher);
      }
    }
  }

  void find_moves() {
    moves_.resize(edge_count());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t e = 0; e < edge_count(); ++e) {
      if (materials_[e].on_boundary && !materials_[e].is_junction) moves_[e] = move_of(e);
    }
  }

  /// Newton's method along the normals. No tet's shape is asked here: whole_move_mm() cuts what is too long.
  [[nodiscard]] NodeMove move_of(std::size_t e) const {
    constexpr int kSteps = 4;
    const auto [a, b] = quadratic_.edges[e];
    const Vec3 middle = 0.5 * (mesh_.points[a] + mesh_.points[b]);
    BoundaryDistance here = distance(middle, e);
    const double before_mm = std::fabs(here.distance_mm);
    Vec3 at = middle;
    for (int step = 0; step < kSteps && here.is_close; ++step) {
      at -= here.distance_mm * here.normal;
      here = distance(at, e);
    }
    if (!here.is_close || std::fabs(here.distance_mm) > before_mm) return {};
    return {.to_boundary_mm = at - middle, .outwards = -1 * here.normal};
  }

  [[nodiscard]] double greatest_move_mm(std::size_t e) const {
    const auto [a, b] = quadratic_.edges[e];
    return options_.greatest_move * (mesh_.points[a] - mesh_.points[b]).norm();
  }

  [[nodiscard]] BoundaryDistance distance(const Vec3& at, std::size_t e) const {
    return domain_.boundary_distance(at, materials_[e].lower, materials_[e].higher);
  }

  void place_nodes() {
#pragma omp parallel for schedule(static)
    for (std::size_t e = 0; e < edge_count(); ++e) place_node(e);
    is_new_.assign(edge_count(), 1);
  }

  void place_node(std::size_t e) {
    const auto [a, b] = quadratic_.edges[e];
    quadratic_.points[quadratic_.corners + e] =
        0.5 * (quadratic_.points[a] + quadratic_.points[b]) +
        share_of(e) * (domain_.image().frame.direction * whole_move_mm(e));
  }

  /// To the boundary and the offset beyond it, if no tet suffers.
  [[nodiscard]] Vec3 whole_move_mm(std::size_t e) const {
    const auto& [to_boundary_mm, outwards] = moves_[e];
    const Vec3 move =
        to_boundary_mm + offsets_.between_mm(materials_[e].lower, materials_[e].higher) * outwards;
    const double length_mm = move.norm(), most_mm = greatest_move_mm(e);
    return length_mm > most_mm ? move * (most_mm / length_mm) : move;
  }

  /// What a move keeps of its whole length.
  [[nodiscard]] double share_of(std::size_t e) const {
    return halvings_[e] >= kMostHalvings ? 0 : std::ldexp(1.0, -halvings_[e]);
  }

  [[nodiscard]] bool may_move(std::size_t e) const {
    return moves_[e].outwards.squared_norm() > 0;
  }
  [[nodiscard]] bool is_moved(std::size_t e) const {
    return may_move(e) && halvings_[e] < kMostHalvings;
  }

  [[nodiscard]] std::size_t edge_of(std::size_t tet, std::size_t node) const {
    return quadratic_.tets.nodes[tet][node] - quadratic_.corners;
  }

  [[nodiscard]] std::vector<std::size_t> tets_with_nodes_that_move() const {
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < quadratic_.tets.size(); ++t) {
      bool moves = false;
      for (std::size_t n = 4; n < 10; ++n) moves |= may_move(edge_of(t, n));
      if (moves) found.push_back(t);
    }
    return found;
  }

  [[nodiscard]] std::array<Vec3, 10> nodes_of(std::size_t t) const {
    std::array<Vec3, 10> places;
    for (std::size_t n = 0; n < 10; ++n) places[n] = quadratic_.points[quadratic_.tets.nodes[t][n]];
    return places;
  }

  /// Tets may hold nodes back after an update, so that it takes some.
  void settle_volumes() {
    constexpr int kRounds = 8;
    for (int round = 0;; ++round) {
      while (hold_back()) {
      }
      measure_tets();
      const std::vector<OffsetArea> areas = offset_areas();
      if (round == kRounds || !offsets_.can_improve(volume_mm3_, areas)) return;
      offsets_.update(volume_mm3_, areas);
      place_nodes();
    }
  }

  /// A third of the facets around each edge, as its node's share lets it move them.
  [[nodiscard]] std::vector<OffsetArea> offset_areas() const {
    std::map<std::pair<MaterialId, MaterialId>, double> areas;
    for (const InterfaceFacet& facet : facets_) {
      const auto& n = facet.nodes;
      const Vec3& p = mesh_.points[n[0]];
      const Vec3 third = (mesh_.points[n[1]] - p).cross(mesh_.points[n[2]] - p) / 6;
      double& area_mm2 = areas[{facet.lower, facet.higher}];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t e = number_of(n[k], n[(k + 1) % 3]);
        area_mm2 += share_of(e) * third.dot(moves_[e].outwards);
      }
    }
    std::vector<OffsetArea> found;
    found.reserve(areas.size());
    for (const auto& [pair, area_mm2] : areas) found.push_back({pair.first, pair.second, area_mm2});
    return found;
  }

  /// Measured in parallel, added up in the order of the tets: sums depend on it.
  void measure_tets() {
    tet_mm3_.resize(mesh_.tets.size());
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < tet_mm3_.size(); ++t) tet_mm3_[t] = volume_of_quadratic_tet(nodes_of(t));
    volume_mm3_.assign(domain_.labels().size(), 0);
    for (std::size_t t = 0; t < tet_mm3_.size(); ++t) volume_mm3_[mesh_.materials[t]] += tet_mm3_[t];
  }

  /// Halves all moves of every tet whose Jacobian is too small. False when there was none.
  bool hold_back() {
    const std::vector<std::uint8_t> suffers = suffering_tets();
    std::fill(is_new_.begin(), is_new_.end(), 0);
    bool any = false;
    for (std::size_t n = 0; n < tets_.size(); ++n) {
      for (std::size_t k = 4; suffers[n] != 0 && k < 10; ++k) {
        const std::size_t e = edge_of(tets_[n], k);
        if (is_new_[e] != 0 || !is_moved(e)) continue;
        is_new_[e] = 1;
        any = true;
        ++halvings_[e];
        place_node(e);
      }
    }
    return any;
  }

  /// Of those with a new place of a node.
  [[nodiscard]] std::vector<std::uint8_t> suffering_tets() const {
    std::vector<std::uint8_t> suffers(tets_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t n = 0; n < tets_.size(); ++n) {
      bool is_new = false;
      for (std::size_t k = 4; k < 10; ++k) is_new |= is_new_[edge_of(tets_[n], k)] != 0;
      suffers[n] = is_new && least_relative_jacobian(nodes_of(tets_[n])) < options_.least_jacobian ? 1 : 0;
    }
    return suffers;
  }

  void describe(CurveReport& report) const {
    report = {};
    for (std::size_t e = 0; e < edge_count(); ++e) {
      report.boundary_edges += materials_[e].on_boundary ? 1 : 0;
      report.curved += is_moved(e) ? 1 : 0;
      report.held_back += is_moved(e) && halvings_[e] > 0 ? 1 : 0;
      report.straight += may_move(e) && !is_moved(e) ? 1 : 0;
    }
    for (std::size_t m = 1; m < volume_mm3_.size(); ++m)
      report.volume_mm3[domain_.labels()[m]] += volume_mm3_[m];
    for (const std::size_t t : tets_)
      report.least_jacobian = std::min(report.least_jacobian, least_relative_jacobian(nodes_of(t)));
  }

  const MaterialMesh& mesh_;
  const ImageDomain& domain_;
  const CurveOptions& options_;
  NodeOffsets offsets_;
  QuadraticMesh quadratic_;
  std::vector<InterfaceFacet> facets_;
  std::vector<EdgeMaterials> materials_;
  std::vector<NodeMove> moves_;
  std::vector<int> halvings_;
  std::vector<std::uint8_t> is_new_;  // edges whose nodes have a new place, which no tet has seen
  std::vector<std::size_t> tets_;     // with nodes that move
  std::vector<double> tet_mm3_, volume_mm3_;
};

}  // namespace

QuadraticMesh curved_quadratic_mesh(const MaterialMesh& mesh, const ImageDomain& domain,
                                    const CurveOptions& options, CurveReport& report) {
  return Curver(mesh, domain, options).run(report);
}

}  // namespace cbc3d

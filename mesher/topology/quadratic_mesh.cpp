#include "mesher/topology/quadratic_mesh.hpp"

#include <algorithm>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

using Edge = std::array<VertexId, 2>;

Edge edge_of(const std::array<VertexId, 4>& tet, std::size_t e) {
  const VertexId a = tet[kQuadraticTetEdges[e][0]], b = tet[kQuadraticTetEdges[e][1]];
  return {std::min(a, b), std::max(a, b)};
}

/// Every edge once, by its lower end: edges of vertex v begin at `begin[v]`.
struct EdgeTable {
  std::vector<Edge> edges;
  std::vector<std::size_t> begin;

  explicit EdgeTable(const Mesh& mesh) : begin(mesh.points.size() + 1, 0) {
    std::vector<Edge> all;
    all.reserve(6 * mesh.tets.size());
    for (const auto& tet : mesh.tets.nodes) {
      for (std::size_t e = 0; e < 6; ++e) all.push_back(edge_of(tet, e));
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    edges = std::move(all);
    for (const Edge& edge : edges) ++begin[edge[0] + 1];
    for (std::size_t v = 0; v < mesh.points.size(); ++v) begin[v + 1] += begin[v];
  }

  [[nodiscard]] std::size_t number_of(const Edge& edge) const {
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(begin[edge[0]]);
    const auto last = edges.begin() + static_cast<std::ptrdiff_t>(begin[edge[0] + 1]);
    return static_cast<std::size_t>(std::lower_bound(first, last, edge) - edges.begin());
  }
};

}  // namespace

QuadraticMesh straight_quadratic_mesh(const Mesh& mesh) {
  if (mesh.tets.size() != mesh.cell_count()) {
    throw InputError(
        "the mesh has pyramids, wedges or hexahedra, which have no quadratic form here; leave out mixed or "
        "take "
        "order 1",
        "order");
  }
  EdgeTable table(mesh);
  QuadraticMesh quadratic;
  quadratic.corners = mesh.points.size();
  quadratic.points = mesh.points;
  quadratic.points.reserve(mesh.points.size() + table.edges.size());
  for (const Edge& edge : table.edges) {
    quadratic.points.push_back(0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]));
  }
  quadratic.tets.nodes.resize(mesh.tets.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets.nodes[t];
    std::copy(tet.begin(), tet.end(), quadratic.tets.nodes[t].begin());
    for (std::size_t e = 0; e < 6; ++e) {
      quadratic.tets.nodes[t][4 + e] =
          static_cast<VertexId>(quadratic.corners + table.number_of(edge_of(tet, e)));
    }
  }
  quadratic.tets.labels = mesh.tets.labels;
  quadratic.edges = std::move(table.edges);
  return quadratic;
}

void flip_orientation(QuadraticMesh& mesh) {
  for (auto& n : mesh.tets.nodes) {  // of the corners 0 and 1, and of the edges at one of them alone
    std::swap(n[0], n[1]);
    std::swap(n[5], n[6]);
    std::swap(n[7], n[8]);
  }
}

Mesh corner_mesh(const QuadraticMesh& mesh) {
  Mesh corners;
  corners.points.assign(mesh.points.begin(), mesh.points.begin() + static_cast<std::ptrdiff_t>(mesh.corners));
  corners.tets.nodes.resize(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::copy_n(mesh.tets.nodes[t].begin(), 4, corners.tets.nodes[t].begin());
  }
  corners.tets.labels = mesh.tets.labels;
  return corners;
}

}  // namespace cbc3d

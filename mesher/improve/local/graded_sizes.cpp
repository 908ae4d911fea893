#include "mesher/improve/local/graded_sizes.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The mean length of the interface edges at every vertex, infinite where it has none. An edge counts once
/// for each of its facets; on a closed surface all edges have two.
std::vector<double> interface_sizes(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::vector<double> sum(mesh.points.size(), 0);
  std::vector<std::uint32_t> edges(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t f = 0; f < 4; ++f) {
      const TetId other = neighbours[t][f];
      if (other != kNoTet && mesh.materials[other] >= mesh.materials[t]) {
        continue;
      }
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const VertexId a = mesh.tets[t][kTetFace[f][corner]];
        const VertexId b = mesh.tets[t][kTetFace[f][(corner + 1) % 3]];
        const double length = (mesh.points[a] - mesh.points[b]).norm();
        for (const VertexId v : {a, b}) {
          sum[v] += length;
          ++edges[v];
        }
      }
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    sum[v] = edges[v] > 0 ? sum[v] / edges[v] : kInfinity;
  }
  return sum;
}

}  // namespace

std::vector<double> graded_sizes(const MaterialMesh& mesh, double gradation, double largest_mm) {
  std::vector<double> size = interface_sizes(mesh);
  // Ways end where they are as long as the largest size: most of a coarse interior is never walked through.
  for (double& s : size) {
    s = std::min(s, largest_mm);
  }
  const VertexCells at = tets_of_vertices(mesh.tets, mesh.points.size());
  using Known = std::pair<double, VertexId>;
  std::priority_queue<Known, std::vector<Known>, std::greater<>> open;  // smallest first
  for (std::size_t v = 0; v < size.size(); ++v) {
    if (size[v] < largest_mm) {
      open.emplace(size[v], static_cast<VertexId>(v));
    }
  }
  while (!open.empty()) {
    const auto [here, v] = open.top();
    open.pop();
    if (here > size[v]) {
      continue;  // a shorter way has been found since
    }
    for (const TetId t : at.of(v)) {
      for (const VertexId w : mesh.tets[t]) {
        const double there = here + gradation * (mesh.points[w] - mesh.points[v]).norm();
        if (there < size[w]) {
          size[w] = there;
          open.emplace(there, w);
        }
      }
    }
  }
  return size;
}

}  // namespace cbc3d

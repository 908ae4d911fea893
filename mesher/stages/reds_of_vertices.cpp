#include "mesher/stages/reds_of_vertices.hpp"

#include <bit>

namespace cbc3d {
namespace {

/// Calls f(vertex) for the nodes of a red tet and the middles of its split edges.
template <typename F>
void for_each_vertex(const Lattice& lattice, const RedTet& red, const F& f) {
  std::for_each(red.nodes.begin(), red.nodes.end(), f);
  for (unsigned left = red.split; left != 0; left &= left - 1) {
    const auto& edge = kRedEdge[static_cast<std::size_t>(std::countr_zero(left))];
    f(lattice.table.find(midpoint(lattice.points[red.nodes[edge[0]]], lattice.points[red.nodes[edge[1]]])));
  }
}

}  // namespace

void RedsOfVertices::build(const Lattice& lattice) {
  drop();
  first_.assign(lattice.points.size() + 1, 0);
  for (const RedTet& red : lattice.reds) {
    for_each_vertex(lattice, red, [&](VertexId v) { ++first_[v + 1]; });
  }
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
    first_[v + 1] += first_[v];
  }
  reds_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t r = 0; r < lattice.reds.size(); ++r) {
    for_each_vertex(lattice, lattice.reds[r], [&](VertexId v) { reds_[next[v]++] = r; });
  }
}

void RedsOfVertices::note_changed(const Lattice& lattice, std::size_t red) {
  last_.resize(lattice.points.size(), kNone);
  for_each_vertex(lattice, lattice.reds[red], [&](VertexId v) {
    later_.push_back({static_cast<std::uint32_t>(red), last_[v]});
    last_[v] = static_cast<std::uint32_t>(later_.size() - 1);
  });
}

}  // namespace cbc3d

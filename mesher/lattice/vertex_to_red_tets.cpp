#include "mesher/lattice/vertex_to_red_tets.hpp"

#include <bit>
#include <numeric>

#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

/// Calls f(vertex) for the middles of a red tet's split edges.
template <typename F>
void for_each_middle(const Lattice& lattice, const RedTet& red, const F& f) {
  for (unsigned left = red.split; left != 0; left &= left - 1) {
    const auto& edge = kRedEdge[static_cast<std::size_t>(std::countr_zero(left))];
    f(lattice.table.find(midpoint(lattice.points[red.nodes[edge[0]]], lattice.points[red.nodes[edge[1]]])));
  }
}

struct Middle {
  VertexId vertex;
  std::uint32_t red;
};

}  // namespace

void VertexToRedTets::build(const Lattice& lattice) {
  drop();
  const auto middles = collect<Middle>(lattice.reds.size(), 6, [&](std::size_t r, const auto& add) {
    for_each_middle(lattice, lattice.reds[r], [&](VertexId v) { add({v, static_cast<std::uint32_t>(r)}); });
  });
  const auto for_each_in = [&](std::size_t begin, std::size_t end, const auto& f) {
    for (std::uint32_t r = 0; r < lattice.reds.size(); ++r) {
      for (const VertexId v : lattice.reds[r].nodes) {
        if (v >= begin && v < end) f(v, r);
      }
    }
    for (const Middle& m : middles) {
      if (m.vertex >= begin && m.vertex < end) f(m.vertex, m.red);
    }
  };
  const std::size_t vertices = lattice.points.size();
  first_.assign(vertices + 1, 0);
  for_ranges(vertices, [&](std::size_t begin, std::size_t end) {
    for_each_in(begin, end, [&](VertexId v, std::uint32_t) { ++first_[v + 1]; });
  });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  reds_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_ranges(vertices, [&](std::size_t begin, std::size_t end) {
    for_each_in(begin, end, [&](VertexId v, std::uint32_t r) { reds_[next[v]++] = r; });
  });
}

void VertexToRedTets::note_changed(const Lattice& lattice, std::size_t red) {
  last_.resize(lattice.points.size(), kNone);
  const auto note = [&](VertexId v) {
    later_.push_back({static_cast<std::uint32_t>(red), last_[v]});
    last_[v] = static_cast<std::uint32_t>(later_.size() - 1);
  };
  const RedTet& changed = lattice.reds[red];
  std::for_each(changed.nodes.begin(), changed.nodes.end(), note);
  for_each_middle(lattice, changed, note);
}

}  // namespace cbc3d

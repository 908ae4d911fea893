#include "metrics/topology.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "metrics/hanging_vertices.hpp"

namespace cbc3d::metrics {
namespace {

// Disjoint sets of cells; the lowest cell of a set is its root.
class CellSets {
 public:
  explicit CellSets(std::size_t cells) : parent_(cells) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// True when a triangle on three vertices of a quad exists among the lone facets: the two do not match.
bool quad_meets_triangle(const std::vector<Facet>& lone) {
  const auto less = [](const Facet& a, const Facet& b) { return a.cycle < b.cycle; };
  for (const Facet& quad : lone) {
    if (quad.cycle[3] == kNoVertex) {
      continue;
    }
    for (std::size_t skipped = 0; skipped < 4; ++skipped) {
      Facet triangle{{kNoVertex, kNoVertex, kNoVertex, kNoVertex}, 0, false};
      std::size_t corners = 0;
      for (std::size_t n = 0; n < 4; ++n) {
        if (n != skipped) {
          triangle.cycle[corners++] = quad.cycle[n];
        }
      }
      std::sort(triangle.cycle.begin(), triangle.cycle.begin() + 3);
      if (std::binary_search(lone.begin(), lone.end(), triangle, less)) {
        return true;
      }
    }
  }
  return false;
}

bool check_runs(const MeshView& view, const std::vector<Facet>& facets, CellSets& sets) {
  bool conforming = true;
  std::vector<Facet> lone;
  const bool all_tets = view.mesh().tets.size() == view.cell_count();
  for_each_facet_run(facets, [&](std::size_t first, std::size_t last) {
    const Facet& one = facets[first];
    if (last - first == 1) {
      if (!all_tets) {
        lone.push_back(one);
      }
      return;
    }
    const Facet& other = facets[first + 1];
    conforming = conforming && last - first == 2 && one.reversed != other.reversed;
    for (std::size_t f = first + 1; f < last; ++f) {
      if (view.label_index(one.cell) == view.label_index(facets[f].cell)) {
        sets.join(one.cell, facets[f].cell);
      }
    }
  });
  return conforming && !quad_meets_triangle(lone);
}

// Corner of a facet: the vertex and its two neighbours along the facet.
struct FacetCorner {
  VertexId at, next, previous;
};

std::vector<FacetCorner> sorted_corners(const Surface& surface, std::uint32_t label) {
  std::vector<FacetCorner> corners;
  corners.reserve(4 * surface.facets_of[label].size());
  for (const std::uint32_t f : surface.facets_of[label]) {
    const SurfaceFacet& facet = surface.facets[f];
    const std::size_t n = facet.corners();
    for (std::size_t c = 0; c < n; ++c) {
      corners.push_back({facet.nodes[c], facet.nodes[(c + 1) % n], facet.nodes[(c + n - 1) % n]});
    }
  }
  std::sort(corners.begin(), corners.end(), [](const FacetCorner& a, const FacetCorner& b) {
    return std::tie(a.at, a.next, a.previous) < std::tie(b.at, b.next, b.previous);
  });
  return corners;
}

// Number of corners of one vertex that are reached from the first by crossing edges.
std::size_t first_fan_size(std::span<const FacetCorner> corners, std::vector<bool>& reached) {
  reached.assign(corners.size(), false);
  reached[0] = true;
  std::size_t size = 1;
  VertexId edge = corners[0].next;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t c = 0; c < corners.size() && !moved; ++c) {
      const bool touches = corners[c].next == edge || corners[c].previous == edge;
      if (!reached[c] && touches) {
        reached[c] = true;
        ++size;
        edge = corners[c].next == edge ? corners[c].previous : corners[c].next;
        moved = true;
      }
    }
  }
  return size;
}

void check_vertex(std::span<const FacetCorner> corners, std::vector<VertexId>& ends,
                  std::vector<bool>& reached, LabelTopology& found) {
  ends.clear();
  for (const FacetCorner& corner : corners) {
    ends.push_back(corner.next);
    ends.push_back(corner.previous);
  }
  std::sort(ends.begin(), ends.end());
  bool manifold_edges = true;
  for (std::size_t first = 0; first < ends.size();) {
    std::size_t last = first;
    while (last < ends.size() && ends[last] == ends[first]) {
      ++last;
    }
    if (last - first != 2) {
      manifold_edges = false;
      found.non_manifold_edges += corners[0].at < ends[first] ? 1 : 0;  // once, at its lower end
    }
    first = last;
  }
  if (manifold_edges && first_fan_size(corners, reached) != corners.size()) {
    ++found.non_manifold_vertices;
  }
}

LabelTopology check_surface(const Surface& surface, std::uint32_t label) {
  LabelTopology found;
  const std::vector<FacetCorner> corners = sorted_corners(surface, label);
  std::vector<VertexId> ends;
  std::vector<bool> reached;
  for (std::size_t first = 0; first < corners.size();) {
    std::size_t last = first;
    while (last < corners.size() && corners[last].at == corners[first].at) {
      ++last;
    }
    check_vertex(std::span(corners).subspan(first, last - first), ends, reached, found);
    first = last;
  }
  return found;
}

}  // namespace

Topology topology(const MeshView& view, const std::vector<Facet>& facets, const Surface& surface) {
  Topology result;
  result.per_label.resize(view.labels().size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t l = 0; l < result.per_label.size(); ++l) {
    result.per_label[l] = check_surface(surface, static_cast<std::uint32_t>(l));
  }
  CellSets sets(view.cell_count());
  result.hanging_vertices = count_hanging_vertices(view, surface);
  result.conforming = check_runs(view, facets, sets) && result.hanging_vertices == 0;
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const auto cell = static_cast<std::uint32_t>(c);
    result.per_label[view.label_index(c)].components += sets.root(cell) == cell ? 1 : 0;
  }
  return result;
}

nlohmann::json to_json(const Topology& topology, const MeshView& view) {
  LabelTopology total;
  auto per_label = nlohmann::json::array();
  for (std::size_t l = 0; l < topology.per_label.size(); ++l) {
    const LabelTopology& one = topology.per_label[l];
    total.non_manifold_edges += one.non_manifold_edges;
    total.non_manifold_vertices += one.non_manifold_vertices;
    total.components += one.components;
    per_label.push_back({{"label", view.labels()[l]},
                         {"non_manifold_edges", one.non_manifold_edges},
                         {"non_manifold_vertices", one.non_manifold_vertices},
                         {"components", one.components}});
  }
  return {{"conforming", topology.conforming},
          {"hanging_vertices", topology.hanging_vertices},
          {"non_manifold_edges", total.non_manifold_edges},
          {"non_manifold_vertices", total.non_manifold_vertices},
          {"components", total.components},
          {"per_label", per_label}};
}

}  // namespace cbc3d::metrics

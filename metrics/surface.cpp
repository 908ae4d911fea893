#include "metrics/surface.hpp"

#include <algorithm>
#include <atomic>
#include <tuple>

namespace cbc3d::metrics {
namespace {

Facet make_facet(const CellView& cell, std::size_t face, std::uint32_t number) {
  Facet facet{{kNoVertex, kNoVertex, kNoVertex, kNoVertex}, number, false};
  std::ptrdiff_t corners = 0;
  for (const int local : shape_of(cell.kind).faces[face]) {
    if (local >= 0) {
      facet.cycle[static_cast<std::size_t>(corners++)] = cell.nodes[static_cast<std::size_t>(local)];
    }
  }
  const auto begin = facet.cycle.begin();
  const auto end = begin + corners;
  std::rotate(begin, std::min_element(begin, end), end);
  if (*(begin + 1) > *(end - 1)) {
    std::reverse(begin + 1, end);
    facet.reversed = true;
  }
  return facet;
}

// Where the facets of each lowest vertex begin in the sorted table.
std::vector<std::uint64_t> facet_offsets(const MeshView& view) {
  std::vector<std::uint64_t> offset(view.mesh().points.size() + 1, 0);
#pragma omp parallel for
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const CellView cell = view.cell(c);
    for (int f = 0; f < shape_of(cell.kind).face_count; ++f) {
      const Facet facet = make_facet(cell, static_cast<std::size_t>(f), 0);
      std::atomic_ref(offset[facet.cycle[0] + 1]).fetch_add(1, std::memory_order_relaxed);
    }
  }
  for (std::size_t v = 1; v < offset.size(); ++v) {
    offset[v] += offset[v - 1];
  }
  return offset;
}

SurfaceFacet surface_facet(const Facet& facet, std::uint32_t inside, std::uint32_t outside) {
  SurfaceFacet result{facet.cycle, inside, outside};
  if (facet.reversed) {
    std::reverse(result.nodes.begin() + 1,
                 result.nodes.begin() + static_cast<std::ptrdiff_t>(result.corners()));
  }
  return result;
}

std::vector<VertexId> distinct_vertices(const Surface& surface, const std::vector<std::uint32_t>& facets,
                                        std::vector<bool>& seen) {
  std::vector<VertexId> vertices;
  for (const std::uint32_t f : facets) {
    const SurfaceFacet& facet = surface.facets[f];
    for (std::size_t n = 0; n < facet.corners(); ++n) {
      if (!seen[facet.nodes[n]]) {
        seen[facet.nodes[n]] = true;
        vertices.push_back(facet.nodes[n]);
      }
    }
  }
  for (const VertexId v : vertices) {
    seen[v] = false;
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace

std::vector<Facet> sorted_facets(const MeshView& view) {
  const std::vector<std::uint64_t> offset = facet_offsets(view);
  std::vector<std::uint64_t> next(offset.begin(), offset.end() - 1);
  std::vector<Facet> facets(offset.back());
#pragma omp parallel for
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const CellView cell = view.cell(c);
    for (int f = 0; f < shape_of(cell.kind).face_count; ++f) {
      const Facet facet = make_facet(cell, static_cast<std::size_t>(f), static_cast<std::uint32_t>(c));
      facets[std::atomic_ref(next[facet.cycle[0]]).fetch_add(1, std::memory_order_relaxed)] = facet;
    }
  }
  // The slots were handed out in any order; a total order within each vertex's few facets settles it.
  const auto less = [](const Facet& a, const Facet& b) {
    return std::tie(a.cycle, a.cell, a.reversed) < std::tie(b.cycle, b.cell, b.reversed);
  };
#pragma omp parallel for schedule(dynamic, 4096)
  for (std::size_t v = 0; v < next.size(); ++v) {
    std::sort(facets.begin() + static_cast<std::ptrdiff_t>(offset[v]),
              facets.begin() + static_cast<std::ptrdiff_t>(offset[v + 1]), less);
  }
  return facets;
}

Surface extract_surface(const MeshView& view, const std::vector<Facet>& facets) {
  Surface surface;
  for_each_facet_run(facets, [&](std::size_t first, std::size_t last) {
    if (last - first == 2) {
      const std::uint32_t inside = view.label_index(facets[first].cell);
      const std::uint32_t outside = view.label_index(facets[first + 1].cell);
      if (inside != outside) {
        surface.facets.push_back(surface_facet(facets[first], inside, outside));
      }
      return;
    }
    for (std::size_t f = first; f < last; ++f) {
      surface.facets.push_back(surface_facet(facets[f], view.label_index(facets[f].cell), kOutside));
    }
  });
  surface.facets_of.resize(view.labels().size());
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const SurfaceFacet& facet = surface.facets[f];
    surface.facets_of[facet.inside].push_back(static_cast<std::uint32_t>(f));
    if (facet.outside != kOutside) {
      surface.facets_of[facet.outside].push_back(static_cast<std::uint32_t>(f));
    }
  }
  std::vector<bool> seen(view.mesh().points.size(), false);
  for (const auto& of_label : surface.facets_of) {
    surface.vertices_of.push_back(distinct_vertices(surface, of_label, seen));
  }
  return surface;
}

FacetTriangles triangles_of(const SurfaceFacet& facet) {
  const auto& n = facet.nodes;
  if (facet.corners() == 3) {
    return {1, {{{n[0], n[1], n[2]}}}};
  }
  // The cycle begins with the lowest vertex.
  return {2, {{{n[0], n[1], n[2]}, {n[0], n[2], n[3]}}}};
}

}  // namespace cbc3d::metrics

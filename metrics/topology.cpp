#include "metrics/topology.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "mesher/core/disjoint_sets.hpp"
#include "metrics/box_tree.hpp"
#include "metrics/hanging_vertices.hpp"

namespace cbc3d::metrics {
namespace {

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

void note(CountedFault& fault, std::size_t at) {
  if (fault.count++ == 0) {
    fault.first = at;
  }
}

// Counts what is wrong with facets and joins the cells of a label that share one.
void check_runs(const MeshView& view, const std::vector<Facet>& facets, DisjointSets& cells,
                Topology& result) {
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
    if (last - first > 2) {
      note(result.overfull_facets, one.cell);
    } else if (one.reversed == facets[first + 1].reversed) {
      note(result.misoriented_facets, one.cell);
    }
    for (std::size_t f = first + 1; f < last; ++f) {
      if (view.label_index(one.cell) == view.label_index(facets[f].cell)) {
        cells.join(one.cell, facets[f].cell);
      }
    }
  });
  result.conforming =
      result.overfull_facets.count == 0 && result.misoriented_facets.count == 0 && !quad_meets_triangle(lone);
}

// A vertex as a primitive of a tree.
struct Site {
  Vec3 at;
  VertexId vertex;

  void add_to(Box& box) const { box.add(at); }
  [[nodiscard]] double squared_distance(const Vec3& p) const { return (p - at).squared_norm(); }
};

void check_vertices(const MeshView& view, Topology& result) {
  constexpr double kRelativeTolerance = 1e-9;  // of the mesh's extent
  const std::vector<Vec3>& points = view.mesh().points;
  std::vector<bool> used(points.size(), false);
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    for (const VertexId v : view.cell(c).nodes) {
      used[v] = true;
    }
  }
  std::vector<Site> sites;
  Box extent;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (used[v]) {
      sites.push_back({points[v], v});
      extent.add(points[v]);
    } else {
      note(result.unused_vertices, v);
    }
  }
  const BoxTree<Site> tree(sites);
  const double squared =
      sites.empty() ? 0 : kRelativeTolerance * kRelativeTolerance * (extent.high - extent.low).squared_norm();
  std::vector<char> twice(sites.size(), 0);
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t n = 0; n < sites.size(); ++n) {
    twice[n] = tree.any_within(sites[n].at, squared,
                               [&](const Site& other) { return other.vertex < sites[n].vertex; });
  }
  for (std::size_t n = 0; n < sites.size(); ++n) {
    if (twice[n] != 0) {
      note(result.duplicate_vertices, sites[n].vertex);
    }
  }
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
  DisjointSets cells(view.cell_count());
  check_runs(view, facets, cells, result);
  check_vertices(view, result);
  result.hanging_vertices = count_hanging_vertices(view, surface);
  result.conforming = result.conforming && result.hanging_vertices.count == 0;
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const auto cell = static_cast<std::uint32_t>(c);
    result.per_label[view.label_index(c)].components += cells.root(cell) == cell ? 1 : 0;
  }
  result.betti = mesh_betti(view, facets);
  return result;
}

namespace {

using nlohmann::json;

void write_betti(json& object, const CellSetTopology& mesh, const VoxelSetTopology* image) {
  object["euler"] = mesh.euler;
  object["betti"] = mesh.betti ? json(mesh.betti->b) : json(nullptr);
  object["image_euler"] = object["image_betti"] = object["image_open_euler"] = object["image_open_betti"] =
      object["image_ambiguous_places"] = object["betti_as_image"] = nullptr;
  if (image == nullptr) {
    return;
  }
  object["image_euler"] = image->closed.euler();
  object["image_betti"] = image->closed.b;
  object["image_open_euler"] = image->open.euler();
  object["image_open_betti"] = image->open.b;
  object["image_ambiguous_places"] = image->ambiguous;
  if (mesh.betti) {
    object["betti_as_image"] = *mesh.betti == image->closed || *mesh.betti == image->open;
  }
}

}  // namespace

nlohmann::json to_json(const Topology& topology, const MeshView& view, const ImageTopology& image_topology,
                       const LabelImage& image) {
  LabelTopology total;
  auto per_label = json::array();
  for (std::size_t l = 0; l < topology.per_label.size(); ++l) {
    const LabelTopology& one = topology.per_label[l];
    total.non_manifold_edges += one.non_manifold_edges;
    total.non_manifold_vertices += one.non_manifold_vertices;
    total.components += one.components;
    json row{{"label", view.labels()[l]},
             {"non_manifold_edges", one.non_manifold_edges},
             {"non_manifold_vertices", one.non_manifold_vertices},
             {"components", one.components}};
    write_betti(row, topology.betti.per_label[l], find_label(image_topology, image, view.labels()[l]));
    per_label.push_back(std::move(row));
  }
  json all;
  write_betti(all, topology.betti.all, &image_topology.all);
  json object{{"conforming", topology.conforming},
              {"hanging_vertices", topology.hanging_vertices.count},
              {"misoriented_facets", topology.misoriented_facets.count},
              {"overfull_facets", topology.overfull_facets.count},
              {"duplicate_vertices", topology.duplicate_vertices.count},
              {"unused_vertices", topology.unused_vertices.count},
              {"non_manifold_edges", total.non_manifold_edges},
              {"non_manifold_vertices", total.non_manifold_vertices},
              {"components", total.components},
              {"all_labels", all}};
  object["per_label"] = std::move(per_label);
  return object;
}

}  // namespace cbc3d::metrics

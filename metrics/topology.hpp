// Does the mesh hang together, and are the surfaces of its labels manifold?
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "metrics/surface.hpp"

namespace cbc3d::metrics {

struct LabelTopology {
  std::int64_t non_manifold_edges = 0;  ///< edges of the label's surface without exactly two facets of it
  /// Vertices of the label's surface, on no such edge, whose facets form more than one fan.
  std::int64_t non_manifold_vertices = 0;
  std::int64_t components = 0;  ///< parts of the label's cells, joined by facets
};

struct Topology {
  /// Every facet belongs to one cell, or to two lying on its two sides; a quad meets quads only; no vertex
  /// hangs.
  bool conforming = true;
  std::int64_t hanging_vertices = 0;     ///< see count_hanging_vertices
  std::vector<LabelTopology> per_label;  ///< by index into MeshView::labels()
};

Topology topology(const MeshView& view, const std::vector<Facet>& facets, const Surface& surface);

/// Keys: conforming, hanging_vertices, non_manifold_edges, non_manifold_vertices, components (each the sum
/// over the labels), per_label with label and the same three for every label of the mesh.
nlohmann::json to_json(const Topology& topology, const MeshView& view);

}  // namespace cbc3d::metrics

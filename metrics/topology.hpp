// Whether the mesh is connected, its labels' surfaces are manifold, and its topology is the image's.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "metrics/counted_fault.hpp"
#include "metrics/image_topology.hpp"
#include "metrics/mesh_betti.hpp"
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
  CountedFault misoriented_facets;  ///< whose two cells lie on the same side: one is inverted; first: a cell
  CountedFault overfull_facets;     ///< with more than two cells; first: a cell
  CountedFault hanging_vertices;    ///< see count_hanging_vertices
  CountedFault duplicate_vertices;  ///< where a lower vertex is, within 1e-9 of the mesh's extent
  CountedFault unused_vertices;     ///< of no cell
  std::vector<LabelTopology> per_label;  ///< by index into MeshView::labels()
  MeshBetti betti;
};

Topology topology(const MeshView& view, const std::vector<Facet>& facets, const Surface& surface);

/// Keys: conforming, hanging_vertices, misoriented_facets, overfull_facets, duplicate_vertices,
/// unused_vertices, non_manifold_edges, non_manifold_vertices, components (each the sum over the labels);
/// per_label has label and the latter three for every label of the mesh, and of the label's cells as a closed
/// set euler and betti ([b0, b1, b2], null where the cells form no set in space), beside it those of the
/// image's voxels with their boundary (image_euler, image_betti) and without (image_open_euler,
/// image_open_betti), the places where these two differ (image_ambiguous_places), and betti_as_image: the
/// mesh's are those of either. all_labels: of all together.
nlohmann::json to_json(const Topology& topology, const MeshView& view, const ImageTopology& image_topology,
                       const LabelImage& image);

}  // namespace cbc3d::metrics

// How element sizes change over a mesh, and how its vertices are connected.
//
// Notation: size     the cube root of an element's volume without its sign (split_into_tets), mm;
//           valence  the number of edges that meet at a vertex.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// The vertices of one label, or of all.
struct InnerVertices {
  std::int64_t vertices = 0;  ///< of at least one cell
  std::int64_t inner = 0;     ///< of these, not on the surface
  [[nodiscard]] std::optional<double> percent() const {
    return vertices > 0 ? std::optional(100 * static_cast<double>(inner) / static_cast<double>(vertices))
                        : std::nullopt;
  }
};

/// A figure is empty where the mesh has no cell; a ratio of neighbours, where no two cells share a facet.
struct Gradation {
  /// Larger over smaller size of two cells that share a facet, whatever their labels; infinite at a flat
  /// cell.
  std::optional<double> size_ratio_p99, size_ratio_max;
  std::optional<std::int64_t> valence_median, valence_p99, valence_max;
  std::size_t valence_max_vertex = 0;  ///< the first that has it
  /// Longest over shortest of the edges at one vertex.
  std::optional<double> vertex_edge_ratio_p99, vertex_edge_ratio_max;
  InnerVertices all;                     ///< surface: facets of one cell, the mesh's outer surface
  std::int64_t off_all_surfaces = 0;     ///< vertices that are on the surface of no label
  std::vector<InnerVertices> per_label;  ///< surface: the label's; by index into MeshView::labels()
};

/// `facets` of `view` (sorted_facets), `surface` made from them. Expected time n, memory 40 bytes a cell.
Gradation gradation(const MeshView& view, const std::vector<Facet>& facets, const Surface& surface);

/// Writes into the section `quality` neighbour_size_ratio ({p99, max}), valence_median, valence_p99,
/// valence_max, valence_max_at_mm, vertex_edge_ratio ({p99, max}), inner_vertices, inner_vertices_percent and
/// vertices_off_surfaces_percent; inner_vertices_percent into each row of its per_label.
void write_json(nlohmann::json& quality, const Gradation& gradation, const MeshView& view);

}  // namespace cbc3d::metrics

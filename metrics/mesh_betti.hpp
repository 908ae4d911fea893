// Euler characteristic and Betti numbers of the labels of a mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "metrics/image_topology.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// The cells of a label with all their faces, edges and vertices (a closed set).
struct CellSetTopology {
  std::int64_t euler = 0;  ///< vertices - edges + faces - cells
  /// Nothing where the cells do not fit together as a set in space: a face with more than two cells, an edge
  /// whose facets do not alternate between inside and outside. The mesh is assumed to be embedded.
  std::optional<Betti> betti;
};

struct MeshBetti {
  std::vector<CellSetTopology> per_label;  ///< by index into MeshView::labels()
  CellSetTopology all;                     ///< all cells as one set
};

/// b0 counts the parts that share no vertex, b2 the parts of the complement (each is the outer
/// side of one connected run of boundary facets; at an edge with more than two of them facets are paired by
/// angle), b1 follows from the Euler characteristic. Time n log n.
MeshBetti mesh_betti(const MeshView& view, const std::vector<Facet>& facets);

}  // namespace cbc3d::metrics

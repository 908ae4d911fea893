// Vertices that sit on a neighbour without being one of its vertices.
#pragma once

#include "metrics/counted_fault.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Vertices of the outer surface that lie in a facet or on an edge of it (within 1e-9 of the
/// mesh's extent) of which they are no vertex: where cells meet edge to half an edge, or where two vertices
/// coincide.
CountedFault count_hanging_vertices(const MeshView& view, const Surface& surface);

}  // namespace cbc3d::metrics

// Facets of a mesh: which cells meet at them, and the surfaces of the labels.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

inline constexpr VertexId kNoVertex = ~VertexId{0};
inline constexpr std::uint32_t kOutside = ~std::uint32_t{0};

/// A facet of a cell, its vertices as a cycle that begins with the lowest and goes on with the lower of that
/// one's two neighbours, so that two cells at the same facet have equal cycles. A triangle ends in kNoVertex.
struct Facet {
  std::array<VertexId, 4> cycle;
  std::uint32_t cell;
  bool reversed;  ///< seen from outside the cell the cycle runs clockwise
};

/// Every facet of every cell, equal ones side by side, in an order that depends on the mesh alone.
std::vector<Facet> sorted_facets(const MeshView& view);

/// Calls visit(first, last) for each run of equal facets, in order.
template <class Visit>
void for_each_facet_run(const std::vector<Facet>& facets, const Visit& visit) {
  for (std::size_t first = 0; first < facets.size();) {
    std::size_t last = first + 1;
    while (last < facets.size() && facets[last].cycle == facets[first].cycle) {
      ++last;
    }
    visit(first, last);
    first = last;
  }
}

/// A facet between two labels, or between a label and the outside.
struct SurfaceFacet {
  std::array<VertexId, 4> nodes;  ///< counter-clockwise seen from outside `inside`; kNoVertex ends a triangle
  std::uint32_t inside;           ///< index into MeshView::labels()
  std::uint32_t outside;          ///< index into MeshView::labels(), or kOutside

  [[nodiscard]] std::size_t corners() const { return nodes[3] == kNoVertex ? 3 : 4; }
};

/// The interfaces of a mesh. A facet belongs to the surface of both labels at it. Where more than two cells
/// share a facet (the mesh does not conform) each of them counts as facing the outside.
struct Surface {
  std::vector<SurfaceFacet> facets;                   ///< sorted by their vertices
  std::vector<std::vector<std::uint32_t>> facets_of;  ///< per label index, ascending
  std::vector<std::vector<VertexId>> vertices_of;     ///< per label index, distinct and ascending
};

Surface extract_surface(const MeshView& view, const std::vector<Facet>& facets);

/// The facet's triangles, a quad cut at its lowest vertex as split_into_tets does.
struct FacetTriangles {
  int count;
  std::array<std::array<VertexId, 3>, 2> triangles;
};
FacetTriangles triangles_of(const SurfaceFacet& facet);

}  // namespace cbc3d::metrics

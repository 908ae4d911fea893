// The neighbours of a vertex along the interfaces it is on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

/// A neighbour along an interface, with the number of facets at the edge to it: two on an interface, three or
/// more on a curve where interfaces meet.
struct SurfaceNeighbour {
  VertexId vertex;
  std::uint32_t facets;
};

/// The neighbours by the facets at a vertex, in order of first sight.
inline void surface_neighbours(const std::vector<FacetAt>& facets,
                               std::vector<SurfaceNeighbour>& neighbours) {
  neighbours.clear();
  for (const FacetAt& f : facets) {
    for (const VertexId w : {f.first, f.second}) {
      const auto found =
          std::find_if(neighbours.begin(), neighbours.end(), [&](const auto& s) { return s.vertex == w; });
      if (found == neighbours.end()) {
        neighbours.push_back({w, 1});
      } else {
        ++found->facets;
      }
    }
  }
}

/// The facets at the edge to v; 0 when v is no neighbour.
inline std::uint32_t facets_to(const std::vector<SurfaceNeighbour>& neighbours, VertexId v) {
  const auto found =
      std::find_if(neighbours.begin(), neighbours.end(), [&](const auto& s) { return s.vertex == v; });
  return found == neighbours.end() ? 0 : found->facets;
}

}  // namespace cbc3d

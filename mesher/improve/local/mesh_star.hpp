// The star of a vertex in a mesh whose tets stay (TetComplex is for those that change).
#pragma once

#include <algorithm>
#include <span>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

inline std::span<const TetId> star_of(const VertexTets& around, VertexId v) {
  return {around.tets.data() + around.first[v], around.tets.data() + around.first[v + 1]};
}

/// The worst angle among some tets, as min_sine_squared has it.
inline double worst_sine_squared(const MaterialMesh& mesh, std::span<const TetId> tets) {
  double worst = 1;
  for (const TetId t : tets) {
    const auto& n = mesh.tets[t];
    worst = std::min(
        worst, min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]));
  }
  return worst;
}

}  // namespace cbc3d

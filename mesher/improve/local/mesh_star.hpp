// The worst angles of a mesh, or of some of its tets, while its tets stay (TetComplex is for tets that
// change).
#pragma once

#include <algorithm>
#include <span>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// Of one tet, as min_sine_squared has it.
inline double sine_squared(const MaterialMesh& mesh, TetId t) {
  const auto& n = mesh.tets[t];
  return min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
}

/// Of some tets; 1 for none.
inline double worst_sine_squared(const MaterialMesh& mesh, std::span<const TetId> tets) {
  double worst = 1;
  for (const TetId t : tets) {
    worst = std::min(worst, sine_squared(mesh, t));
  }
  return worst;
}

/// Of all tets; 1 for none. Parallel.
inline double worst_sine_squared(const MaterialMesh& mesh) {
  double worst = 1;
#pragma omp parallel for schedule(static) reduction(min : worst)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    worst = std::min(worst, sine_squared(mesh, static_cast<TetId>(t)));
  }
  return worst;
}

}  // namespace cbc3d

// The quality of the worst tet of a mesh, or of some of its tets, while its tets stay (TetComplex is for tets
// that change).
#pragma once

#include <algorithm>
#include <span>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// Of one tet (tet_shape.hpp).
inline double quality(const MaterialMesh& mesh, TetId t) {
  const auto& n = mesh.tets[t];
  return tet_quality(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
}

/// Of some tets; 1 for none.
inline double worst_quality(const MaterialMesh& mesh, std::span<const TetId> tets) {
  double worst = 1;
  for (const TetId t : tets) {
    worst = std::min(worst, quality(mesh, t));
  }
  return worst;
}

/// The smallest value of a function of a tet's corners over all tets of the mesh; 1 for none. Parallel.
template <typename OfCorners>
double smallest_over_tets(const MaterialMesh& mesh, const OfCorners& of_corners) {
  double smallest = 1;
#pragma omp parallel for schedule(static) reduction(min : smallest)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    smallest = std::min(
        smallest, of_corners(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]));
  }
  return smallest;
}

/// The worst quality, and the squared sine of the worst angle, of all tets.
inline double worst_quality(const MaterialMesh& mesh) {
  return smallest_over_tets(mesh, tet_quality);
}
inline double worst_sine_squared(const MaterialMesh& mesh) {
  return smallest_over_tets(mesh, min_sine_squared);
}

}  // namespace cbc3d

// The initial mesh of a block: the leaves of the octree, filled by the templates. Its surfaces are those of
// the voxels.
#pragma once

#include "baselines/ld/label_octree.hpp"
#include "baselines/ld/lattice_mesh.hpp"

namespace cbc3d::baselines::ld {

struct InitialMeshOptions {
  bool with_background = false;  ///< fill the background's leaves too; the grid needs a margin then
  bool with_pieces = false;      ///< list the pieces of the boundary
};

/// The mesh of a block of the grid. Vertices on the boundary of the block are frozen. With background those
/// on the boundary of the grid are points, which never move.
LatticeMesh initial_mesh(const CellGrid& grid, const LabelOctree& octree, const Index3& block,
                         const InitialMeshOptions& options);

}  // namespace cbc3d::baselines::ld

// LD: lattice decimation. Chernikov and Chrisochoides: Multitissue tetrahedral image-to-mesh conversion with
// guaranteed quality and fidelity, SIAM Journal on Scientific Computing 33(6), 2011. Written from what is
// published about the method, not from its code.
#pragma once

#include "baselines/ld/decimation.hpp"
#include "mesher/core/stage_clock.hpp"

namespace cbc3d::baselines::ld {

struct LatticeDecimationOptions {
  DecimationOptions decimation = {};
  bool clean = true;  ///< voxels of a label that touch at an edge or a corner alone are joined or cut first
  int block = 64;     ///< side of the blocks in cells, a power of two, at least 2
};

/// Meshes an image. The result is in physical space with the image's own labels. What is guaranteed against
/// the image, cleaned if so wished: no dihedral angle is outside its bounds; the surfaces of every label, and
/// every interface of two, are within the distances; topology is that of the voxels as closed sets; tets are
/// positive and conform. Same result at any thread count. Throws InputError where the bounds cannot be met.
Mesh mesh_by_lattice_decimation(const LabelImage& image, const LatticeDecimationOptions& options,
                                StageClock& stages);

}  // namespace cbc3d::baselines::ld

// Where an image itself is only one or two voxels thick.
#pragma once

#include "mesher/core/label_image.hpp"

namespace cbc3d::metrics {

/// How far from a place on a mesh thin voxels are looked for, in voxels along each axis. A mesh may stand
/// about a voxel off the image, and what is thin there has its own vertices a voxel further.
inline constexpr int kThinReach = 2;

/// True when near `centre` (a voxel, which may lie outside the image) there is a voxel of the set that no 3 x
/// 3 x 3 block of the set holds: the morphological opening with that block removes it, so the set is at most
/// two voxels thick there. The set is a material, or with `complement` all that is not the material, the
/// outside of the image included. An opening with a block leaves every half-space of voxels as it is, however
/// it lies, so the steps of an oblique plane are not thin.
bool is_thin_near(const LabelImage& image, const Index3& centre, MaterialId material, bool complement);

}  // namespace cbc3d::metrics

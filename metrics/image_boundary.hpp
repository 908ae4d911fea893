// The boundary of every material of a label image: its voxels and the voxel faces it shows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "metrics/box_tree.hpp"

namespace cbc3d::metrics {

/// A face of a voxel at which the material changes.
struct VoxelFace {
  std::array<std::int32_t, 3> voxel;  ///< i, j, k of the voxel within the material
  std::uint8_t axis;                  ///< 0, 1, 2: the axis it is normal to
  std::int8_t side;                   ///< -1 or +1: towards lower or higher indices
  MaterialId other = kBackground;     ///< material beyond the face; background outside the image
};

/// Centre of a voxel face in the image's local frame, mm.
Vec3 centre_of(const VoxelFace& face, const ImageFrame& frame);

/// The face as a flat box in the image's local frame, mm.
Box box_of(const VoxelFace& face, const ImageFrame& frame);

/// Area of a voxel face normal to each axis, mm2.
Vec3 voxel_face_areas_mm2(const ImageFrame& frame);

struct MaterialBoundary {
  std::vector<Vec3> voxel_centres;  ///< of the boundary voxels (is_boundary_voxel), local mm, in memory order
  std::vector<VoxelFace> faces;     ///< every face towards another material or the outside
};

/// The smallest box that holds some voxels; both ends inclusive, empty when low > high.
struct VoxelBox {
  Index3 low{0, 0, 0}, high{-1, -1, -1};
};

/// The box of all voxels of a material: its boundary voxels reach as far as any.
VoxelBox box_of(const MaterialBoundary& boundary);

/// One entry per material, that of background left empty. The outside of the image counts as background.
std::vector<MaterialBoundary> image_boundaries(const LabelImage& image);

}  // namespace cbc3d::metrics

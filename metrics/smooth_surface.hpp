// The smooth surface of a label: what a mesh that shows no voxel steps is compared with.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "metrics/box_tree.hpp"
#include "metrics/image_boundary.hpp"

namespace cbc3d::metrics {

/// A triangle of a label's smooth surface and the material on its other side.
struct SmoothTriangle {
  Triangle triangle;  ///< image's local frame, mm
  MaterialId other;
  /// Each corner lies on a line between two voxel centres; corners of one label with equal numbers are one.
  std::array<std::uint64_t, 3> corner;
};

/// Zero level of s(x) = f_m(x) - max over n != m of f_n(x), where f_n is the indicator of material n smoothed
/// by a Gaussian with a standard deviation of one voxel along each axis (cut off at two), by marching cubes
/// between the voxel centres. Between two materials it is the same surface seen from either. At every voxel
/// centre s keeps the sign that the segmentation has there (it is moved to a twentieth beyond 0 where
/// smoothing would turn it), so nothing is lost however thin, and the surface lies within half a voxel of the
/// voxel faces along some axis. Outside the image is background. Empty for background and for a material
/// without voxels. Same triangles in the same order at any thread count.
std::vector<SmoothTriangle> smooth_surface(const LabelImage& image, MaterialId material);

/// The same where the box of the material's voxels is known, so that no more than that is looked at.
std::vector<SmoothTriangle> smooth_surface(const LabelImage& image, MaterialId material, const VoxelBox& box);

}  // namespace cbc3d::metrics

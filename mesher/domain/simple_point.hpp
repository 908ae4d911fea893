// Which voxels can change sides without a change of topology (Bertrand and Malandain, A new characterization
// of three-dimensional simple points, Pattern Recognition Letters 15, 1994): voxels of a set are connected
// across faces, those of its complement across corners too.
#pragma once

#include <array>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Of the 27 voxels around one, itself at 13: which are of the set.
using VoxelNeighbourhood = std::array<bool, 27>;

/// The n-th of the 27 voxels around `at`, x fastest.
Index3 voxel_neighbour(const Index3& at, std::size_t n);

/// True when the voxel in the middle can enter or leave the set and no part, tunnel or cavity comes or goes.
/// What the middle itself is does not matter.
bool is_simple(const VoxelNeighbourhood& around);

}  // namespace cbc3d

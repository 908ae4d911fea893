// Where a mesh's labels have another topology than the image's, told by parts of voxels.
//
// A mesh never has all of a voxel in tets of the voxel's label: its surfaces are smooth, and its tets are
// larger. That changes no topology where the parts in question can take the mesh's label one after the
// other, each being simple for the label that it leaves and for the one that it enters. What is left then
// lies where pieces, tunnels or cavities of some label came or went. Halves of voxels are the coarsest grid
// on which a slanted wire one voxel thick stays in one piece.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

inline constexpr int kHalves = 2;

/// Into how many parts a voxel is cut along each axis: `fewest` along its shortest side, and more along
/// longer ones, so that parts are about cubes.
Index3 voxel_parts(const ImageFrame& image, int fewest = kHalves);

/// The image's frame, cut so.
ImageFrame part_frame(const ImageFrame& image, int fewest = kHalves);

/// A part of a voxel that the mesh has in another material than the image.
struct MisplacedPart {
  std::size_t offset = 0;  ///< in the part frame
  MaterialId in_mesh = 0;
};

/// Offsets in the image, ascending, of the voxels with misplaced parts that cannot take the mesh's label
/// without a change of topology of one of `labels`, none of them background. `misplaced` ascends by offset.
/// `fewest` is that of its parts.
std::vector<std::size_t> find_topology_differences(const LabelImage& image,
                                                   const std::vector<MisplacedPart>& misplaced,
                                                   const std::vector<Label>& labels, int fewest = kHalves);

/// The voxels that have misplaced parts: offsets in the image, ascending.
std::vector<std::size_t> voxels_of_parts(const ImageFrame& image, const std::vector<MisplacedPart>& parts,
                                         int fewest = kHalves);

}  // namespace cbc3d

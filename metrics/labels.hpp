// Which labels the image and the mesh share.
#pragma once

#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

struct LabelComparison {
  std::vector<Label> missing;  ///< in the image (at least one voxel), in no cell; ascending
  std::vector<Label>
      unknown;  ///< in a cell, in no voxel of the image; ascending. 0 is background, not unknown
};

/// `voxels` as LabelImage::voxels_per_material gives them.
LabelComparison compare_labels(const MeshView& view, const LabelImage& image,
                               const std::vector<std::size_t>& voxels);

}  // namespace cbc3d::metrics

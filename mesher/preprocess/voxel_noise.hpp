// Stage "Relabeling noisy voxels" (paper, section "Image pre-processing").
#pragma once

#include <cstddef>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

enum class NoisyVoxels {
  none,
  holes,   ///< the paper's first type: background voxels all of whose 26 neighbours are labelled
  specks,  ///< the second type: labelled voxels none of whose 26 neighbours has their label
  both,
};

struct NoiseReport {
  std::size_t holes_filled = 0;
  std::size_t specks_relabelled = 0;
};

/// Gives every noisy voxel the material that most of its 26 neighbours have; the more face neighbours win a
/// tie, then the smaller material number. All voxels are judged by the image as it was, in parallel. The
/// outside of the image counts as background. The paper leaves open which neighbour is followed.
NoiseReport relabel_noisy_voxels(LabelImage& image, NoisyVoxels which);

}  // namespace cbc3d

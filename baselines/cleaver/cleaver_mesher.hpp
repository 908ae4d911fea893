// Lattice cleaving of a label image (Bronson, Levine and Whitaker, Lattice Cleaving, IMR 2012 and TVCG 20(2),
// 2014).
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/stage_clock.hpp"

namespace cbc3d::baselines::cleaver {

struct CleaverOptions {
  double sampling_rate = 1;    ///< cells of size 1 for each voxel along an edge
  double lipschitz = 0.2;      ///< growth of the cells' size with the distance from the boundary
  double feature_scaling = 1;  ///< factor of the cells' sizes
  /// Standard deviation of the Gaussian that blurs each label's mask, mm; 0: one voxel along each axis.
  double blur_mm = 0;
  bool graded = true;  ///< an octree's cells by the sizing field; otherwise cells of size 1 everywhere
};

struct CleaverResult {
  Mesh mesh;                       ///< physical, with the image's own labels
  std::vector<std::string> notes;  ///< what a user should know of it, one sentence each
};

/// Meshes the labels of `image`. Throws InputError where nothing is labelled or the blur is too wide,
/// JobError where the lattice has too many cells.
CleaverResult mesh_with_cleaver(const LabelImage& image, const CleaverOptions& options, StageClock& stages);

}  // namespace cbc3d::baselines::cleaver

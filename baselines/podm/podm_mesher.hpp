// PODM on a label image, from the image to the mesh.
#pragma once

#include <string>
#include <vector>

#include "baselines/podm/refinement.hpp"
#include "mesher/core/stage_clock.hpp"

namespace cbc3d::baselines::podm {

struct PodmOptions {
  RefinementOptions refinement;
  /// `refinement.delta_mm` is 1.2 times the edge of a cube as large as a voxel, whatever was given.
  bool delta_by_voxel = false;
  /// The surface is smooth boundaries between the voxels' centres; otherwise the voxels' faces.
  bool smooth = false;
};

struct PodmResult {
  Mesh mesh;                       ///< physical, with the image's own labels
  std::vector<std::string> notes;  ///< what a user should know of it, one sentence each
  RefinementCounts counts;
};

/// Meshes the labels of `image`. Throws InputError where nothing is labelled.
PodmResult mesh_with_podm(const LabelImage& image, const PodmOptions& options, StageClock& stages);

}  // namespace cbc3d::baselines::podm

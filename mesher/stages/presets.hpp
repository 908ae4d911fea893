// Named sets of options.
#pragma once

#include <string>
#include <vector>

#include "mesher/stages/mesh_image.hpp"

namespace cbc3d {

/// "quality": our best so far. The paper's stages with what measurably improves them: refinement also where a
///   boundary voxel has no interface vertex within two voxel diagonals (the paper's fidelity never notices a
///   lost vessel tip), targets on the voxel faces between the labels (no volume bias of half a voxel), no
///   region dropped.
/// "paper": the published method with the published parameters. Where the paper is silent or stops, both
///   presets do the same: sources move along the normal, far pairs of source and target are pulled together,
///   and only the vertices of failing elements are held back (OnFailure::stop is the paper's own end).
std::vector<std::string> preset_names();

/// The options of a preset for an image. Throws InputError for an unknown name.
MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame);

}  // namespace cbc3d

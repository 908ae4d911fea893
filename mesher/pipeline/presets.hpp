// Named sets of options.
#pragma once

#include <string>
#include <vector>

#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

/// The first is the default.
///
/// "quality" gives the best meshes we know how to make. The lattice is refined where a boundary voxel has no
/// vertex of
///   its interface within a voxel diagonal, or where a vertex lies farther than 1.25 from its interface,
///   instead of by the fidelity; its labels are those of the smoothed image. Vertices then move to the
///   boundary, and the tets are improved and decimated under guards (stage "improvement") in place of the
///   elastic deformation. No region is dropped, and voxels change only where a label's touch at edges or
///   corners alone, so that it has one topology. Mixed elements are merged from stars of
///   the lattice deep inside, which the improvement leaves alone.
/// "paper" is the published method with the published parameters. Where the paper is silent or stops, both
/// presets do
///   the same: sources move along the normal, far pairs of source and target are pulled together, and only
///   the vertices of failing elements are held back (OnFailure::stop is the paper's own end).
std::vector<std::string> preset_names();

/// The options of a preset for an image; MeshImageOptions::mixed is off. Throws InputError for an unknown
/// name.
MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame);

/// The same for the deformation of a given mesh: it replaces the improvement. Throws InputError for an
/// unknown name.
MeshImageOptions deformation_preset_options(const std::string& name);

}  // namespace cbc3d

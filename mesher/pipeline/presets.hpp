// Named sets of options.
#pragma once

#include <string>
#include <vector>

#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

/// "quality": our best. The lattice is refined where a boundary voxel has no vertex of its interface within
///   1.06 voxel diagonals, or a vertex of an interface is farther than 1.25 from it, instead of by the
///   fidelity (domain/tolerances.hpp); its labels are those of the smoothed image; vertices then move to the
///   boundary and the tets are improved and thinned out under guards (stage "improvement") in place of the
///   elastic deformation. No region is dropped and no voxel changed. With mixed elements, which the
///   improvement does not know, it is the paper's method with targets on the voxels' faces and refinement by
///   distance.
/// "paper": the published method with the published parameters. Where the paper is silent or stops, both
///   presets do the same: sources move along the normal, far pairs of source and target are pulled together,
///   and only the vertices of failing elements are held back (OnFailure::stop is the paper's own end).
std::vector<std::string> preset_names();

/// The options of a preset for an image, for a mesh of tets or of mixed elements. Throws InputError for an
/// unknown name.
MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame, bool mixed = false);

}  // namespace cbc3d

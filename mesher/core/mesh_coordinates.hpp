// Points of meshes in other coordinates than LPS mm.
//
// Notation: "LPS"    physical mm towards the patient's left, posterior, superior, as in memory;
//           "RAS"    physical mm towards right, anterior, superior: x and y have the other sign;
//           "voxel"  indices of the image, (0,0,0) at the centre of its first voxel.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// Takes a mesh from LPS to these coordinates; cells stay positively oriented, also where the axes of the
/// image are left-handed. `frame` (or null) is needed for voxel. Throws InputError for other coordinates and
/// for voxel without a frame.
void from_lps(Mesh& mesh, const std::string& coordinates, const ImageFrame* frame);

/// The same for points alone; true where the cells are inside out afterwards.
bool from_lps(std::vector<Vec3>& points, const std::string& coordinates, const ImageFrame* frame);

/// The way back, for files that state their coordinates.
void to_lps(Mesh& mesh, const std::string& coordinates, const ImageFrame* frame);

}  // namespace cbc3d

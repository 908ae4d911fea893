// What a finished mesh lacks of its image, as warnings.
#pragma once

#include <string>
#include <vector>

#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

/// Self-intersections that are left, and every label whose volume is more than 2 % off that of its voxels in
/// the cleaned image, each with the option that helps. Of a mesh of order 2 the corners' mesh is given; its
/// volumes are those of the curved tets, from the report.
std::vector<std::string> mesh_findings(const Mesh& mesh, const MeshImageReport& report,
                                       const ImageFrame& frame);

}  // namespace cbc3d

// Whether a mesh lies where its image lies.
#pragma once

#include <string>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d {

struct Placement {
  double overlap = 1;      ///< share of the cells whose centres lie on voxels of their own label
  std::string finding;     ///< empty where mesh and image lie together
  bool elsewhere = false;  ///< they certainly do not: hardly any overlap, or another frame fits far better
};

/// Compares a mesh (physical LPS mm) with an image. Less than half an overlap is a finding, for a mesh with
/// one or two elements across a label has more; the finding says which other frame would fit:
/// right-anterior-superior in place of LPS, x or y mirrored alone, voxel indices. The nodes of the cells must
/// exist.
Placement placement_of(const Mesh& mesh, const LabelImage& image);

}  // namespace cbc3d

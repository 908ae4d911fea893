// Whether a foreign mesh lies where its image lies.
#pragma once

#include <string>

#include "mesher/core/label_image.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// The share of the cells, by their centres, that lie on voxels of their own label.
double label_overlap(const MaterialMesh& mesh, const LabelImage& image);

struct Placement {
  double overlap = 1;
  std::string finding;   ///< empty where mesh and image lie together
  bool elsewhere = false;  ///< they certainly do not: hardly any overlap, or another frame fits far better
};

/// Compares a mesh (local mm of the image) with the image. Less than half an overlap is a finding, for a mesh
/// with one or two elements across a label has more; it says which other frame would fit: right-anterior-superior
/// in place of LPS, x or y mirrored alone, voxel indices.
Placement placement_of(const MaterialMesh& mesh, const LabelImage& image);

}  // namespace cbc3d

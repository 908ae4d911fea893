// The tet mesh between lattice and output: local mm, materials in place of labels.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/stages/tet_adjacency.hpp"

namespace cbc3d {

struct MaterialMesh {
  std::vector<Vec3> points;           ///< local mm
  TetNodes tets;                      ///< positively oriented
  std::vector<MaterialId> materials;  ///< one a tet
};

/// The tets that are not background, with only the vertices they use; the order of both is kept.
MaterialMesh discard_background(const std::vector<Vec3>& points, const TetNodes& tets,
                                const std::vector<MaterialId>& materials);

/// The mesh in physical space with the image's label values.
Mesh to_physical_mesh(const MaterialMesh& mesh, const LabelImage& image);

}  // namespace cbc3d

// What the stages of the method have to say of an image, each in a sentence that names the option that helps.
// They are appended to MeshImageReport::warnings.
#pragma once

#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// Regions that became background, and voxels that were changed where a label touched itself.
void warn_of_cleaning(const CleanReport& clean, MeshImageReport& report);
/// No label is dropped silently, and no region of one either.
void warn_of_losses(const LabelImage& image, const MaterialMesh& mesh, MeshImageReport& report);
/// Labels of other numbers of parts than in the cleaned image, and vertices that are left non-manifold.
void warn_of_topology(const MeshImageOptions& options, MeshImageReport& report);
/// Of the finished mesh, from MeshImageReport::topology_differences.
void warn_of_topology_differences(MeshImageReport& report);
/// The deformation ended before its last iteration.
void warn_of_early_stop(MeshImageReport& report);
/// A dihedral angle is below the goal of the improvement.
void warn_of_angles(const MeshImageOptions& options, MeshImageReport& report);
/// Hexahedra were asked for and there are none.
void warn_of_missing_hexes(const MeshImageOptions& options, MeshImageReport& report);
/// Where the image has more parts than so few elements can hold, or the lattice is too coarse for so many.
void warn_of_elements(const MeshImageOptions& options, std::size_t cells, MeshImageReport& report);

}  // namespace cbc3d

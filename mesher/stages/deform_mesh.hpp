// Stage "Mesh Deformation" of the paper: moves surfaces and interfaces to the image's boundaries by energy
// minimisation under quality control.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesher/stages/deformation_points.hpp"
#include "mesher/stages/elasticity.hpp"
#include "mesher/stages/material_mesh.hpp"

namespace cbc3d {

/// What happens where an element stays below the minimum quality after all attempts.
enum class OnFailure {
  stop,     ///< the paper: the whole mesh goes back to the previous iteration and the deformation ends
  recover,  ///< only the vertices of failing elements go back, and the deformation goes on
};

struct DeformOptions {
  int iterations = 5;                                             ///< N_iter
  Connectivity connectivity = Connectivity::no;                   ///< pattern of the target points
  TargetPosition target_position = TargetPosition::voxel_centre;  ///< where a target lies
  double min_dihedral_deg = 5;                                    ///< quality every tet keeps, degrees
  double scale_at_failure = 0.2;  ///< factor on displacements around a failing element
  int attempts = 3;               ///< solves with scaled displacements before giving up
  OnFailure on_failure = OnFailure::recover;
  ElasticityOptions elasticity;
};

struct DeformIteration {
  std::size_t matched_sources = 0;  ///< sources with a target in reach
  double mean_displacement_mm = 0;  ///< asked of the matched sources
  double max_displacement_mm = 0;
  int attempts = 0;                    ///< solves with scaled displacements
  std::size_t recovered_vertices = 0;  ///< vertices put back to the previous iteration
  SolveReport solver;
};

struct DeformReport {
  std::size_t sources = 0;
  std::size_t targets = 0;
  bool stopped_early = false;
  std::vector<DeformIteration> iterations;
};

/// Deforms `mesh` (local mm) towards `image`. Every tet keeps at least the minimum dihedral angle, or what it
/// had before where that was less. `on_iteration(i)` is called before each iteration. Same result at any
/// thread count.
DeformReport deform_mesh(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options,
                         const std::function<void(int iteration)>& on_iteration);

}  // namespace cbc3d

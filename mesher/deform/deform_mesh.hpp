// Stage "Mesh Deformation" of the paper: moves surfaces and interfaces to the image's boundaries by energy
// minimisation under quality control.
#pragma once

#include <functional>
#include <vector>

#include "mesher/core/stage_clock.hpp"
#include "mesher/deform/elasticity.hpp"
#include "mesher/deform/quality_control.hpp"
#include "mesher/deform/source_displacements.hpp"

namespace cbc3d {

/// What happens where an element falls below the minimum quality.
enum class OnFailure {
  stop,     ///< the paper: displacements around it are scaled and the system is solved again; after some
            ///< attempts the whole mesh goes back to the previous iteration and the deformation ends
  recover,  ///< only the vertices of failing elements are held back, and the deformation goes on
};

struct DeformOptions {
  int iterations = 5;                            ///< N_iter
  Connectivity connectivity = Connectivity::no;  ///< pattern of the target points
  DisplacementOptions displacement;              ///< D
  ElasticityOptions elasticity;                  ///< K
  QualityOptions quality;                        ///< what every cell keeps
  double scale_at_failure = 0.2;                 ///< stop: factor on D around a failing element
  int attempts = 3;                              ///< stop: solves with scaled D before giving up
  OnFailure on_failure = OnFailure::recover;
};

struct DeformIteration {
  std::size_t matched_sources = 0;  ///< sources with a target in reach
  double mean_displacement_mm = 0;  ///< asked of the matched sources
  double max_displacement_mm = 0;
  int attempts = 0;               ///< solves with scaled displacements
  std::size_t held_vertices = 0;  ///< vertices that the local step control held back
  SolveReport solver;             ///< of the last solve
};

struct DeformReport {
  std::size_t sources = 0;
  std::size_t targets = 0;
  bool stopped_early = false;
  std::vector<DeformIteration> iterations;
  /// Seconds by part: extraction, displacements, assembly, solve, quality_control.
  StageSeconds part_seconds;
};

/// Deforms `mesh` (local mm) towards `image`. Every cell keeps at least the minimum quality, or what it had
/// before where that was less. `on_iteration(i)` is called before each iteration. Same result at any thread
/// count.
DeformReport deform_mesh(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options,
                         const std::function<void(int iteration)>& on_iteration);

}  // namespace cbc3d

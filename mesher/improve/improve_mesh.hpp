// Stage "improvement and decimation", beyond the paper: fewer and better tets for the same boundaries.
//
// Vertices move, edges are removed, interfaces flipped and edges collapsed, under guards for angles, distance
// from the domain's boundaries, coverage of the boundary samples, manifoldness and the topology of every
// label's surface. ALGORITHM.md has the functional, the operations, the schedule, and what is guaranteed and
// what is not.
#pragma once

#include <functional>
#include <map>
#include <span>

#include "mesher/core/stage_clock.hpp"
#include "mesher/domain/domain.hpp"
#include "mesher/domain/tolerances.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// The scale is Domain::scale_mm: the voxel diagonal of an image.
struct ImproveOptions {
  bool enabled = false;
  double min_dihedral_deg = 20;  ///< goal: no dihedral angle below this, none above 180 degrees minus it
  double reach_mm = 0;      ///< every boundary sample keeps a covering vertex within this; 0: kReach scales
  double deviation_mm = 0;  ///< facets stay within this of the boundary; 0: deviation_diagonals scales
  double deviation_diagonals = tolerances::kDeviation;
  /// The mean length of edges on interfaces, about: the decimation makes none longer than 1.4 times that; 0:
  /// as long as reach and deviation allow. For edges shorter than those, at which a smaller reach would have
  /// the surface follow the steps of the voxels.
  double surface_edge_mm = 0;
  double surface_weight =
      1000;  ///< weight of the distances from the boundary, in scales, against the tets' shape
  /// In [0,1]: the share of the surface weight that goes to smooth surfaces, see RelaxOptions; 0: none.
  double smoothness = 0.7;
  /// The smoothness moves no vertex farther from the boundary; 0: kSmoothnessCap scales, the deviation at
  /// most.
  double smoothness_cap_mm = 0;
  /// The mean length of edges of these labels, about: the decimation makes none longer than 1.4 times that.
  std::map<Label, double> size_mm;
  /// No inner vertex vanishes where that leaves edges longer than those of the nearest interface and about
  /// this times the distance from there (graded_sizes). Interfaces are decimated as ever. Below 0: no limit.
  double gradation = 1;
  /// Where a part is thinner than its edges would be long, the decimation makes them about this many times as
  /// long as it is thick (part_thickness.hpp); 0: no limit.
  double edges_per_thickness = 2;
  /// Collapses may leave angles below the goal by this, though not below half of it, for later steps to
  /// repair.
  double collapse_leeway_deg = 7.5;
  /// Above 0: the decimation ends at about this many tets. Reach, deviation and inner edges grow from round
  /// to round until there are no more, and it ends before it is done when there are.
  std::size_t target_tets = 0;
  int decimation_rounds = 6;  ///< at most; 0: as many tets as before
  int repair_rounds = 12;     ///< at most; they end when the goal is reached
  int untangle_rounds = 3;    ///< at most, before all else, while a tet is flat or inside out
  bool only_bad = false;  ///< only tets below the goal and those around them; no relaxation, no decimation
  /// The reach is no larger than the largest distance of a covered sample was, and uncovered samples are kept
  /// from growing farther: a finished mesh does not trade its distances for fewer elements.
  bool keep_distances = false;
  bool may_relabel =
      true;  ///< tets may change their material where the surfaces have defects that nothing else mends
  /// Relabelling leaves the labels' topology as it is: for meshes that have the domain's.
  bool keep_topology = false;
  bool correct_volumes = true;  ///< the volumes of labels become those of the domain
};

struct ImproveReport {
  int rounds = 0;
  std::size_t tets_before = 0, tets_after = 0;
  double min_dihedral_before_deg = 0, min_dihedral_after_deg = 0;
  std::size_t boundary_samples = 0;
  std::size_t uncovered_samples = 0;  ///< in the end
  std::size_t tets_relabelled = 0;    ///< in the last stage: at far vertices, pinches and self-intersections
  std::size_t self_intersections_left = 0;  ///< pairs of facets between labels, or outer ones
  std::size_t surface_defects_left = 0;     ///< see DefectRemovalReport
  /// Seconds by part, in the order of their first occurrence.
  StageSeconds part_seconds;
};

/// Improves a mesh of tets (local mm) towards the domain. Same result at any thread count. Tets that are not
/// positive are untangled where that is possible, and else stay. Vertices with a nonzero entry in `fixed`,
/// which is empty or has one for each vertex, keep their places, and tets with fixed vertices alone stay as
/// they are, unless a tet beside them cannot be brought to the goal otherwise. None of them may be on an
/// interface.
ImproveReport improve_mesh(MaterialMesh& mesh, const Domain& domain, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round,
                           std::span<const std::uint8_t> fixed = {});

}  // namespace cbc3d

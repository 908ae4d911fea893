// D of the deformation: how far each source should move (paper, section "Quality control"; the paper's
// reference CBC3DYixun for the average and its projection).
#pragma once

#include <vector>

#include "mesher/deform/deformation_points.hpp"
#include "mesher/deform/target_rows.hpp"

namespace cbc3d {

/// Where a target lies.
enum class TargetPosition {
  voxel_centre,  ///< the paper's: the centre of the boundary voxel, half a voxel inside the boundary
  voxel_faces,   ///< the centres of the voxel's faces towards other materials: on the boundary
};

struct DisplacementOptions {
  TargetPosition target_position = TargetPosition::voxel_centre;
  bool along_normal = true;  ///< only along the surface's normal, except where three or more materials meet
  bool reject_outliers =
      true;          ///< leave out targets whose boundary looks the other way, as the far side of a thin wall
  double reach = 3;  ///< a source with no target in its region takes the nearest within so many region radii
  double pair_distance =
      0.5;  ///< no pair of source and nearest target may stay farther apart, voxel diagonals; 0: off
};

/// What the search works with; all must outlive it.
struct Correspondence {
  const SourcePoints& sources;
  const TargetPoints& targets;
  const MaterialSets& sets;
  const ImageFrame& frame;
};

struct SourceDisplacement {
  Vec3 vector;
  bool matched = false;
};

/// For each source the mean of the vectors to the targets of its material set in the ball round it whose
/// radius is the mean length of its surface edges; zero with `matched` 0 where there is none. Sources whose
/// set no target has use the nearest of those sets that are nearest to theirs. Parallel; the same result at
/// any thread count. What is the same at all positions is made ready once.
class SourceDisplacements {
 public:
  /// What `points` refers to must outlive this.
  SourceDisplacements(const Correspondence& points, const DisplacementOptions& options)
      : points_(points), options_(options), rows_(points.targets, points.frame) {}

  /// With the vertices of the mesh at these positions.
  [[nodiscard]] std::vector<SourceDisplacement> at(const std::vector<Vec3>& positions);

 private:
  void pull_pairs(const std::vector<Vec3>& positions, double most_mm, std::vector<SourceDisplacement>& found);

  Correspondence points_;
  DisplacementOptions options_;
  TargetRows rows_;
  std::vector<std::uint64_t> source_of_target_, target_of_source_;  // pairs; kept for their memory
};

}  // namespace cbc3d

// The few figures by which a mesh is judged first, in one place.
#pragma once

#include <nlohmann/json.hpp>

#include "mesher/core/label_image.hpp"
#include "metrics/element_quality.hpp"
#include "metrics/fidelity.hpp"
#include "metrics/self_intersection.hpp"
#include "metrics/topology.hpp"
#include "metrics/topology_difference.hpp"

namespace cbc3d::metrics {

/// Volume errors of labels of no more voxels than this say little: half a voxel's layer is most of them.
inline constexpr std::size_t kVoxelsForVolumeError = 500;
/// Labels of no more voxels than this may be missing.
inline constexpr std::size_t kVoxelsToBeThere = 50;

/// How many labels are listed for the lowest Dice and for the largest volume error each.
inline constexpr std::size_t kWorstLabels = 3;

/// What summary is made of.
struct Judged {
  const MeshView& view;
  const ImageFrame& frame;
  const MeshQuality& quality;
  const Topology& topology;
  const TopologyDifference& difference;
  const SelfIntersections& crossing;
  const Fidelity& fidelity;
};

/// Keys: elements; min_dihedral_deg, inverted, voxel_diagonal_mm; of the paper's Hausdorff distance
/// hausdorff_mm, image_to_mesh_mm, mesh_to_image_mm, the largest of any label, and union_hausdorff_mm and so
/// on, all labels as one against background; each of these six also in voxel diagonals
/// (image_to_mesh_diagonals); volume_error_percent (with its sign) of the label above kVoxelsForVolumeError
/// voxels where it is largest; dice_min; worst_labels, rows of {label, voxels, dice, volume_error_percent} of
/// the kWorstLabels labels of lowest Dice and of as many, above kVoxelsForVolumeError voxels, of largest
/// volume error, lowest Dice first; missing_labels (a list, of those above kVoxelsToBeThere voxels);
/// non_manifold_edges, non_manifold_vertices, self_intersections; topology_differences
/// (topology_difference.hpp). Figures that are the worst of the labels have that label beside them as
/// min_dihedral_label, hausdorff_label, image_to_mesh_label, mesh_to_image_label, volume_error_label,
/// dice_label (null where there is none), counts the labels that have any: inverted_labels,
/// non_manifold_labels, self_intersection_labels, topology_difference_labels.
nlohmann::json summary(const Judged& mesh);

}  // namespace cbc3d::metrics

#include "mesher/pipeline/presets.hpp"

#include "mesher/core/error.hpp"
#include "mesher/domain/tolerances.hpp"

namespace cbc3d {

std::vector<std::string> preset_names() {
  return {"quality", "paper"};
}

namespace {

/// The image's boundary by distance, both ways, for every interface; what the improvement then keeps.
void refine_by_distance(MeshImageOptions& options, double diagonal_mm) {
  RefineOptions& refine = options.refine;
  refine.fidelity = 0.01;
  refine.max_distance_mm = tolerances::kReach * diagonal_mm;
  refine.each_interface = true;
  refine.max_vertex_distance_mm = tolerances::kLatticeFarLimit * diagonal_mm;
  refine.contact_distance_mm = tolerances::kContact * diagonal_mm;
  refine.smooth_labels = true;
  refine.one_face_rule = false;
  refine.topology_rounds = 0;
  refine.repair_rounds = 4;
  refine.repair_image_passes = 4;
}

/// With hexes and pyramids, which the improvement does not know: the deformation on the voxels' faces.
MeshImageOptions mixed_quality_options(double diagonal_mm) {
  MeshImageOptions options;
  options.clean.region_tolerance = 0;
  options.refine.max_distance_mm = 2 * diagonal_mm;
  options.deform.displacement.target_position = TargetPosition::voxel_faces;
  options.deform.displacement.pair_distance = 0.8;
  return options;
}

MeshImageOptions quality_options(double diagonal_mm) {
  MeshImageOptions options;
  options.clean.region_tolerance = 0;
  options.clean.manifold_voxels = false;  // the mesh's own repair decides with less change
  refine_by_distance(options, diagonal_mm);
  options.topology.enabled = true;
  options.topology.one_face_rule = false;
  options.topology.image_passes = 4;
  options.topology.small_component = 0;
  options.deform.iterations = 0;
  options.deform.displacement.target_position = TargetPosition::voxel_faces;
  options.deform.displacement.pair_distance = 0.8;
  options.improve.enabled = true;
  options.improve.reach_mm = options.refine.max_distance_mm;
  options.stricter = Tolerance{.max_distance_mm = tolerances::kStrictReach * diagonal_mm,
                               .deviation_diagonals = tolerances::kStrictDeviation,
                               .collapse_leeway_deg = 0};
  return options;
}

}  // namespace

MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame, bool mixed) {
  MeshImageOptions options;
  if (name == "quality") {
    return mixed ? mixed_quality_options(frame.voxel_diagonal_mm())
                 : quality_options(frame.voxel_diagonal_mm());
  }
  if (name == "paper") {
    return options;
  }
  throw InputError("--preset " + name + ": unknown; give quality or paper");
}

}  // namespace cbc3d

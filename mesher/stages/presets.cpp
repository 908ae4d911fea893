#include "mesher/stages/presets.hpp"

#include "mesher/core/error.hpp"

namespace cbc3d {

std::vector<std::string> preset_names() {
  return {"quality", "paper"};
}

MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame) {
  MeshImageOptions options;
  if (name == "quality") {
    options.clean.region_tolerance = 0;
    options.refine.max_distance_mm = 0.9 * frame.voxel_diagonal_mm();
    options.refine.fidelity = 0.01;
    options.refine.each_interface = true;
    options.refine.smooth_labels = true;
    options.refine.contact_reach_mm = 0.45 * frame.voxel_diagonal_mm();
    options.refine.max_stray_mm = 1.25 * frame.voxel_diagonal_mm();
    options.refine.one_face_rule = false;
    options.refine.topology_rounds = 0;
    options.refine.repair_rounds = 4;
    options.refine.repair_image_passes = 4;
    options.topology.enabled = true;
    options.topology.one_face_rule = false;
    options.topology.image_passes = 4;
    options.topology.small_component = 0;
    options.deform.iterations = 0;
    options.improve.enabled = true;
    options.deform.displacement.target_position = TargetPosition::voxel_faces;
    options.deform.displacement.pair_distance = 0.8;
    return options;
  }
  if (name == "paper") {
    return options;
  }
  throw InputError("--preset " + name + ": unknown; give quality or paper");
}

}  // namespace cbc3d

#include "mesher/pipeline/presets.hpp"

#include <algorithm>

#include "mesher/core/error.hpp"
#include "mesher/domain/tolerances.hpp"

namespace cbc3d {

std::vector<std::string> preset_names() {
  return {"quality", "paper"};
}

namespace {

/// The deformation's targets lie on the boundary itself, not half a voxel inside.
constexpr DisplacementOptions kTargetsOnBoundary{.target_position = TargetPosition::voxel_faces,
                                                 .pair_distance = 0.8};

/// The image's boundary by distance, both ways, for every interface: what the improvement then keeps.
RefineOptions refinement_by_distance(double diagonal_mm) {
  return {.fidelity = 0.01,
          .max_distance_mm = tolerances::kReach * diagonal_mm,
          .max_vertex_distance_mm = tolerances::kLatticeFarLimit * diagonal_mm,
          .contact_distance_mm = tolerances::kContact * diagonal_mm,
          .keep_thin_parts = true,
          .smooth_labels = true,
          .each_interface = true,
          .one_face_rule = false,
          .topology_rounds = 0,
          .repair_rounds = 32,
          .repair_image_passes = 4,
          .keep_topology = true};
}

MeshImageOptions quality_options(double diagonal_mm) {
  const RefineOptions refine = refinement_by_distance(diagonal_mm);
  return {.clean = {.region_tolerance = 0, .well_composed = true},
          .refine = refine,
          .topology = {.enabled = true, .one_face_rule = false, .image_passes = 4, .small_component = 0},
          .mix = {.min_scaled_jacobian = 0.5},
          .deform = {.iterations = 0, .displacement = kTargetsOnBoundary},
          .improve = {.enabled = true, .reach_mm = refine.max_distance_mm}};
}

void require_known_preset(const std::string& name) {
  const std::vector<std::string> names = preset_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError("preset '" + name + "' is unknown; give quality or paper", "preset");
  }
}

}  // namespace

MeshImageOptions preset_options(const std::string& name, const ImageFrame& frame) {
  require_known_preset(name);
  return name == "quality" ? quality_options(frame.voxel_diagonal_mm()) : MeshImageOptions{};
}

MeshImageOptions deformation_preset_options(const std::string& name) {
  require_known_preset(name);
  MeshImageOptions options;
  if (name == "quality") {
    options.deform.displacement = kTargetsOnBoundary;
  }
  return options;
}

}  // namespace cbc3d

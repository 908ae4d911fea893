#include "baselines/podm/podm_mesher.hpp"

#include <cmath>

#include "baselines/core/missing_labels.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines::podm {
namespace {

// Orphans are single tets, or a few of them.
constexpr std::size_t kOrphanTets = 8;

double voxel_delta_mm(const LabelImage& image) {
  constexpr double kVoxelEdges = 1.2;  // the published delta of images of 1 mm
  const Vec3& h = image.frame.spacing_mm;
  return kVoxelEdges * std::cbrt(h.x * h.y * h.z);
}

std::vector<std::string> notes_of(const LabelImage& image, const RefinementResult& result) {
  std::vector<std::string> notes;
  if (!result.sampled.empty()) {
    notes.push_back(names_of(image, result.sampled) +
                    ": too small for delta, so sampled at their own voxels");
  }
  const std::vector<MaterialId> missing = missing_materials(image, result.complex.materials);
  if (!missing.empty())
    notes.push_back(names_of(image, missing) + ": not in the mesh, too small even so; give a smaller delta");
  if (result.counts.removals_capped)
    notes.emplace_back("the removal of free vertices near the surface (rule 6) ended at its cap");
  return notes;
}

}  // namespace

PodmResult mesh_with_podm(const LabelImage& image, const PodmOptions& options, StageClock& stages) {
  stages.start("nearest boundary");
  const SurfaceOracle oracle(image, options.smooth);
  if (!oracle.has_surface()) throw InputError("the image has no labelled voxel: there is nothing to mesh");
  RefinementOptions refinement = options.refinement;
  if (options.delta_by_voxel) refinement.delta_mm = voxel_delta_mm(image);
  stages.start("refine");
  RefinementResult refined = refine(image, oracle, refinement);
  stages.start("repair labels");
  repair_orphans(refined.complex, kOrphanTets, [&](const Vec3& p) { return oracle.material_at(p); });
  PodmResult result{mesh_of(refined.complex, image.labels), notes_of(image, refined), refined.counts};
  map_to_physical(result.mesh, image.frame);
  stages.stop();
  return result;
}

}  // namespace cbc3d::baselines::podm

#include "mesher/preprocess/clean_image.hpp"

#include "mesher/preprocess/well_composed.hpp"

namespace cbc3d {

CleanReport clean_image(LabelImage& image, const CleanOptions& options, bool split) {
  CleanReport report;
  const std::size_t labels = image.material_count();
  const bool removes_regions = options.region_tolerance > 0;
  std::vector<std::size_t> before;
  if (options.relabel_noise != NoisyVoxels::none || !removes_regions) {  // else the removal counts on its way
    before = image.voxels_per_material();
  }
  report.noise = relabel_noisy_voxels(image, options.relabel_noise);
  if (removes_regions) {
    report.removed = remove_small_regions(image, options.region_tolerance);
    before = before.empty() ? report.removed.voxels_before : before;
  }
  const bool as_before =
      report.noise.holes_filled + report.noise.specks_relabelled == 0 && report.removed.regions_removed == 0;
  std::vector<std::size_t> after = as_before ? before : image.voxels_per_material();
  if (options.manifold_voxels) {
    report.contacts =
        options.well_composed ? make_well_composed(image) : remove_voxel_contacts(image, options.seed);
    for (std::size_t m = 0; m < labels; ++m) {
      after[m] += static_cast<std::size_t>(report.contacts.gained[m]);  // modulo 2^64, so losses come off
    }
  }
  for (std::size_t m = 1; m < labels; ++m) {
    report.labels.push_back({image.labels[m], before[m], after[m]});
  }
  if (split) {
    report.regions = split_regions(image);
  }
  return report;
}

}  // namespace cbc3d

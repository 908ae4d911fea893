#include "mesher/stages/clean_image.hpp"

namespace cbc3d {

CleanReport clean_image(LabelImage& image, const CleanOptions& options, bool split) {
  CleanReport report;
  const std::vector<std::size_t> before = image.voxels_per_material();
  const std::size_t labels = image.material_count();

  report.noise = relabel_noisy_voxels(image, options.relabel_noise);
  if (options.region_tolerance > 0) {
    report.removed = remove_small_regions(image, options.region_tolerance);
  }
  if (options.manifold_voxels) {
    report.contacts = remove_voxel_contacts(image, options.seed);
  }
  const std::vector<std::size_t> after = image.voxels_per_material();
  for (std::size_t m = 1; m < labels; ++m) {
    report.labels.push_back({image.labels[m], before[m], after[m]});
  }
  if (split) {
    report.regions = split_regions(image);
  }
  return report;
}

}  // namespace cbc3d

#include "baselines/core/missing_labels.hpp"

#include <algorithm>

namespace cbc3d::baselines {

std::vector<MaterialId> missing_materials(const LabelImage& image, const std::vector<MaterialId>& found) {
  std::vector<char> seen(image.material_count(), 0);
  for (const MaterialId m : found) seen[m] = 1;
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  std::vector<MaterialId> missing;
  for (std::size_t m = 1; m < seen.size(); ++m) {
    if (seen[m] == 0 && voxels[m] > 0) missing.push_back(static_cast<MaterialId>(m));
  }
  return missing;
}

std::string names_of(const LabelImage& image, const std::vector<MaterialId>& materials) {
  constexpr std::size_t kMostNamed = 10;
  std::string text = materials.size() == 1 ? "label " : "labels ";
  for (std::size_t n = 0; n < std::min(kMostNamed, materials.size()); ++n)
    text += (n == 0 ? "" : ", ") + std::to_string(image.labels[materials[n]]);
  if (materials.size() > kMostNamed)
    text += " and " + std::to_string(materials.size() - kMostNamed) + " more";
  return text;
}

}  // namespace cbc3d::baselines

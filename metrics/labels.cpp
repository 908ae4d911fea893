#include "metrics/labels.hpp"

#include <algorithm>
#include <iterator>

namespace cbc3d::metrics {

LabelComparison compare_labels(const MeshView& view, const LabelImage& image,
                               const std::vector<std::size_t>& voxels) {
  std::vector<Label> in_image;
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    if (voxels[m] > 0) {
      in_image.push_back(image.labels[m]);
    }
  }
  std::sort(in_image.begin(), in_image.end());
  LabelComparison result;
  const auto& in_mesh = view.labels();
  std::set_difference(in_image.begin(), in_image.end(), in_mesh.begin(), in_mesh.end(),
                      std::back_inserter(result.missing));
  std::set_difference(in_mesh.begin(), in_mesh.end(), in_image.begin(), in_image.end(),
                      std::back_inserter(result.unknown));
  std::erase(result.unknown, 0);
  return result;
}

}  // namespace cbc3d::metrics

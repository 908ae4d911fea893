#include "mesher/core/label_image.hpp"

#include <cmath>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

Index3 ImageFrame::index_of(std::size_t offset) const {
  const auto nx = static_cast<std::size_t>(size[0]);
  const auto ny = static_cast<std::size_t>(size[1]);
  return {static_cast<int>(offset % nx), static_cast<int>(offset / nx % ny),
          static_cast<int>(offset / nx / ny)};
}

MaterialId LabelImage::at_local(const Vec3& local_mm) const {
  const double i = std::floor(local_mm[0] / frame.spacing_mm[0] + 0.5);
  const double j = std::floor(local_mm[1] / frame.spacing_mm[1] + 0.5);
  const double k = std::floor(local_mm[2] / frame.spacing_mm[2] + 0.5);
  if (i < 0 || j < 0 || k < 0 || i >= frame.size[0] || j >= frame.size[1] || k >= frame.size[2]) {
    return kBackground;
  }
  return at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
}

std::vector<std::size_t> LabelImage::voxels_per_material() const {
  std::vector<std::size_t> total(material_count(), 0);
  const auto row = static_cast<std::size_t>(frame.size[0]);
  const std::size_t rows = row > 0 ? voxels.size() / row : 0;
  voxels.visit([&](const auto* all) {
#pragma omp parallel
    {
      std::vector<std::size_t> mine(material_count(), 0);
#pragma omp for nowait
      for (std::size_t r = 0; r < rows; ++r) {
        const auto* begin = all + r * row;
        for (int i = 0; i < frame.size[0];) {
          const int end = end_of_run(begin, i, frame.size[0]);
          mine[begin[i]] += static_cast<std::size_t>(end - i);
          i = end;
        }
      }
#pragma omp critical(cbc3d_voxels_per_material)
      for (std::size_t m = 0; m < total.size(); ++m) {
        total[m] += mine[m];
      }
    }
  });
  return total;
}

std::vector<double> values_of_materials(const LabelImage& image, const std::map<Label, double>& of_label,
                                        double otherwise) {
  std::vector<double> values(image.material_count(), otherwise);
  for (std::size_t m = 1; m < values.size(); ++m) {
    const auto own = of_label.find(image.labels[m]);
    values[m] = own != of_label.end() ? own->second : otherwise;
  }
  return values;
}

bool is_boundary_voxel(const LabelImage& image, int i, int j, int k) {
  const MaterialId own = image.at(i, j, k);
  return image.at_or_background(i - 1, j, k) != own || image.at_or_background(i + 1, j, k) != own ||
         image.at_or_background(i, j - 1, k) != own || image.at_or_background(i, j + 1, k) != own ||
         image.at_or_background(i, j, k - 1) != own || image.at_or_background(i, j, k + 1) != own;
}

}  // namespace cbc3d

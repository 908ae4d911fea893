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

std::optional<Index3> ImageFrame::voxel_at_local(const Vec3& local_mm) const {
  Index3 at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double index = std::floor(local_mm[axis] / spacing_mm[axis] + 0.5);
    if (index < 0 || index >= size[axis]) {
      return std::nullopt;
    }
    at[axis] = static_cast<int>(index);
  }
  return at;
}

MaterialId LabelImage::at_local(const Vec3& local_mm) const {
  const std::optional<Index3> voxel = frame.voxel_at_local(local_mm);
  return voxel ? at((*voxel)[0], (*voxel)[1], (*voxel)[2]) : kBackground;
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

std::vector<double> values_of_materials(const std::vector<Label>& labels,
                                        const std::map<Label, double>& of_label, double otherwise) {
  std::vector<double> values(labels.size(), otherwise);
  for (std::size_t m = 1; m < values.size(); ++m) {
    const auto own = of_label.find(labels[m]);
    values[m] = own != of_label.end() ? own->second : otherwise;
  }
  return values;
}

bool is_boundary_voxel(const LabelImage& image, int i, int j, int k) {
  const MaterialId own = image.at(i, j, k);
  const Index3& size = image.frame.size;
  if (i > 0 && j > 0 && k > 0 && i + 1 < size[0] && j + 1 < size[1] && k + 1 < size[2]) {
    const std::size_t at = image.frame.offset(i, j, k);
    const auto row = static_cast<std::size_t>(size[0]);
    const std::size_t slice = row * static_cast<std::size_t>(size[1]);
    const LabelVoxels& voxels = image.voxels;
    return voxels[at - 1] != own || voxels[at + 1] != own || voxels[at - row] != own ||
           voxels[at + row] != own || voxels[at - slice] != own || voxels[at + slice] != own;
  }
  return image.at_or_background(i - 1, j, k) != own || image.at_or_background(i + 1, j, k) != own ||
         image.at_or_background(i, j - 1, k) != own || image.at_or_background(i, j + 1, k) != own ||
         image.at_or_background(i, j, k - 1) != own || image.at_or_background(i, j, k + 1) != own;
}

std::vector<MaterialId> first_of_label(const LabelImage& image) {
  std::vector<MaterialId> first(image.material_count());
  std::map<Label, MaterialId> known;
  for (std::size_t m = 0; m < first.size(); ++m) {
    first[m] = known.try_emplace(image.labels[m], static_cast<MaterialId>(m)).first->second;
  }
  return first;
}

namespace {

bool has_background_beside(const LabelImage& image, int i, int j, int k) {
  return image.at(i, j, k) != kBackground && (image.at_or_background(i - 1, j, k) == kBackground ||
                                              image.at_or_background(i + 1, j, k) == kBackground ||
                                              image.at_or_background(i, j - 1, k) == kBackground ||
                                              image.at_or_background(i, j + 1, k) == kBackground ||
                                              image.at_or_background(i, j, k - 1) == kBackground ||
                                              image.at_or_background(i, j, k + 1) == kBackground);
}

/// Calls f(centre, squared distance) for the boundary voxels within reach until it returns true.
template <typename F>
void for_each_boundary_voxel_near(const LabelImage& image, const Vec3& local_mm, MaterialId material,
                                  double reach_mm, const F& f) {
  const ImageFrame& frame = image.frame;
  Index3 low;
  Index3 high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double at = local_mm[axis] / frame.spacing_mm[axis];
    const double reach = reach_mm / frame.spacing_mm[axis];
    low[a] = std::max(0, static_cast<int>(std::ceil(at - reach)));
    high[a] = std::min(frame.size[a] - 1, static_cast<int>(std::floor(at + reach)));
  }
  const auto is_one = [&](int i, int j, int k) {
    return material == kBackground ? has_background_beside(image, i, j, k)
                                   : image.labels[image.at(i, j, k)] == image.labels[material] &&
                                         is_boundary_voxel(image, i, j, k);
  };
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vec3 centre = frame.local_centre(i, j, k);
        const double squared = (centre - local_mm).squared_norm();
        if (squared <= reach_mm * reach_mm && is_one(i, j, k) && f(centre, squared)) {
          return;
        }
      }
    }
  }
}

}  // namespace

std::optional<Vec3> nearest_boundary_voxel(const LabelImage& image, const Vec3& local_mm, MaterialId material,
                                           double reach_mm) {
  std::optional<Vec3> nearest;
  double least = reach_mm * reach_mm;
  for_each_boundary_voxel_near(image, local_mm, material, reach_mm, [&](const Vec3& centre, double squared) {
    if (!nearest || squared < least) {
      nearest = centre;
      least = squared;
    }
    return false;
  });
  return nearest;
}

bool has_boundary_voxel_near(const LabelImage& image, const Vec3& local_mm, MaterialId material,
                             double reach_mm) {
  bool found = false;
  for_each_boundary_voxel_near(image, local_mm, material, reach_mm,
                               [&](const Vec3&, double) { return found = true; });
  return found;
}

}  // namespace cbc3d

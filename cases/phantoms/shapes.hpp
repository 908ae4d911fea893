// Filling label images by predicates on positions; boxes and balls for tests.
#pragma once

#include <algorithm>

#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

/// An image of background whose materials 1..count carry the labels 1..count.
LabelImage blank_image(const Index3& size, const Vec3& spacing_mm, int label_count);

/// Middle of the image in local mm, and its shortest side.
Vec3 middle_of(const ImageFrame& frame);
double shortest_side_mm(const ImageFrame& frame);

/// Sets every voxel to material_at(centre in local mm), in parallel.
template <class MaterialAt>
void fill_image(LabelImage& image, const MaterialAt& material_at) {
  const Index3 size = image.frame.size;
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        image.voxels[image.frame.offset(i, j, k)] = material_at(image.frame.local_centre(i, j, k));
      }
    }
  }
}

/// One label, a box of voxels from `low` to `high` inclusive.
LabelImage box_image(const Index3& size, const Vec3& spacing_mm, const Index3& low, const Index3& high);

/// One label, a ball in the middle of the image.
LabelImage ball_image(const Index3& size, const Vec3& spacing_mm, double radius_mm);

}  // namespace cbc3d::cases

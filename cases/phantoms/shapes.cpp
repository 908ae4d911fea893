#include "cases/phantoms/shapes.hpp"

namespace cbc3d::cases {

LabelImage blank_image(const Index3& size, const Vec3& spacing_mm, int label_count) {
  LabelImage image;
  image.frame.size = size;
  image.frame.spacing_mm = spacing_mm;
  for (int label = 1; label <= label_count; ++label) {
    image.labels.push_back(label);
  }
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  return image;
}

Vec3 middle_of(const ImageFrame& frame) {
  return 0.5 * frame.local_centre(frame.size[0] - 1, frame.size[1] - 1, frame.size[2] - 1);
}

double shortest_side_mm(const ImageFrame& frame) {
  return Vec3{frame.size[0] * frame.spacing_mm.x, frame.size[1] * frame.spacing_mm.y,
              frame.size[2] * frame.spacing_mm.z}
      .min_coeff();
}

LabelImage box_image(const Index3& size, const Vec3& spacing_mm, const Index3& low, const Index3& high) {
  LabelImage image = blank_image(size, spacing_mm, 1);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        image.voxels[image.frame.offset(i, j, k)] = 1;
      }
    }
  }
  return image;
}

LabelImage ball_image(const Index3& size, const Vec3& spacing_mm, double radius_mm) {
  LabelImage image = blank_image(size, spacing_mm, 1);
  const Vec3 middle = middle_of(image.frame);
  fill_image(image, [&](const Vec3& p) -> MaterialId {
    return (p - middle).squared_norm() <= radius_mm * radius_mm ? 1 : 0;
  });
  return image;
}

}  // namespace cbc3d::cases

// Grey images of a winding vessel under noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "mesher/core/image_io.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::testing {

/// A vessel that winds upwards through an image 44 x 44 x 60 mm.
struct Vessel {
  double x, y, radius;

  [[nodiscard]] Vec3 middle(double z) const {
    return {x + 5 * std::sin(z / 11), y + 4 * std::cos(z / 14), z};
  }
  [[nodiscard]] double distance(const Vec3& p) const {
    double least = 1e9;
    for (double z = 6; z <= 54; z += 0.25) {
      least = std::min(least, (p - middle(z)).norm());
    }
    return least - radius;
  }
};

inline ImageFrame frame_of_44x44x60_mm(const Vec3& spacing_mm) {
  ImageFrame frame;
  frame.spacing_mm = spacing_mm;
  frame.size = {static_cast<int>(44 / spacing_mm.x), static_cast<int>(44 / spacing_mm.y),
                static_cast<int>(60 / spacing_mm.z)};
  return frame;
}

/// Grey values (100 around, 100 + contrast within, blurred over a voxel, normal noise) written as an image,
/// and the truth.
inline LabelImage write_grey(const std::filesystem::path& path, const ImageFrame& frame,
                             const std::function<double(const Vec3&)>& distance_at, double contrast,
                             double noise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, noise);
  LabelImage grey, truth;
  grey.frame = truth.frame = frame;
  truth.labels = {0, 1};
  for (Label value = 1; value < 1000; ++value) {
    grey.labels.push_back(value);
  }
  const double blur = 0.4 * frame.spacing_mm.max_coeff();
  for (std::size_t v = 0; v < frame.voxel_count(); ++v) {
    const Index3 at = frame.index_of(v);
    const double distance = distance_at(frame.local_centre(at[0], at[1], at[2]));
    const double within = 1 / (1 + std::exp(distance / blur));
    const double value = 300 + contrast * within + normal(random);
    grey.voxels.push_back(static_cast<MaterialId>(std::clamp(value, 1.0, 999.0)));
    truth.voxels.push_back(distance <= 0 ? 1 : 0);
  }
  write_label_image(grey, path);
  return truth;
}

}  // namespace cbc3d::testing

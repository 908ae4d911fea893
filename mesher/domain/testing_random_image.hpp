// Random images and random places in them.
#pragma once

#include <cstdint>
#include <random>

#include "mesher/testing/random_draws.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::testing {

inline constexpr Vec3 kAnisotropic = {0.7, 1.1, 1.9};

/// A place in the image or within the margin of it.
inline Vec3 draw_in(std::mt19937& random, const ImageFrame& frame, double margin_mm) {
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    const double end = (frame.size[static_cast<std::size_t>(axis)] - 1) * frame.spacing_mm[axis];
    x[axis] = draw(random, -margin_mm, end + margin_mm);
  }
  return x;
}

/// Materials drawn voxel by voxel, up to the image's border.
inline LabelImage random_image(const Index3& size, const Vec3& spacing_mm, int materials,
                               std::uint32_t seed) {
  std::mt19937 random(seed);
  return testing::make_image(size, spacing_mm, materials, [&](const Vec3&) {
    return static_cast<int>(random() % static_cast<unsigned>(materials + 1));
  });
}

}  // namespace cbc3d::testing

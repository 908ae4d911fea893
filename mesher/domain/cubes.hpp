// Space is cut into cubes, to find what is near a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Cubes without bounds, each with a key. Cubes that follow each other along x have consecutive keys.
struct CubeKeys {
  double edge_mm;

  [[nodiscard]] Index3 cube_of(const Vec3& x) const {
    return {static_cast<int>(std::floor(x.x / edge_mm)), static_cast<int>(std::floor(x.y / edge_mm)),
            static_cast<int>(std::floor(x.z / edge_mm))};
  }
  static std::uint64_t key(const Index3& cube) {
    constexpr int kShift = 1 << 20;  // cubes may have negative indices
    return (static_cast<std::uint64_t>(cube[2] + kShift) << 42) |
           (static_cast<std::uint64_t>(cube[1] + kShift) << 21) |
           static_cast<std::uint64_t>(cube[0] + kShift);
  }
};

/// The cubes that an image lies in, numbered.
struct ImageCubes {
  double edge_mm;
  double cubes_per_mm;
  ImageFrame grid{};  ///< one voxel for each cube; no more than its size counts

  ImageCubes(const ImageFrame& image, double edge) : edge_mm(edge), cubes_per_mm(1 / edge) {
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      grid.size[axis] = static_cast<int>(image.size[axis] * image.spacing_mm[d] / edge_mm) + 1;
    }
  }

  [[nodiscard]] std::size_t count() const { return grid.voxel_count(); }
  /// The cube that holds x; the nearest one for what is outside, which is no farther from any place inside.
  [[nodiscard]] Index3 cube_of(const Vec3& x) const {
    Index3 cube;
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      cube[axis] = std::clamp(static_cast<int>(x[d] * cubes_per_mm), 0, grid.size[axis] - 1);
    }
    return cube;
  }
  [[nodiscard]] std::size_t number(const Index3& cube) const {
    return grid.offset(cube[0], cube[1], cube[2]);
  }
};

}  // namespace cbc3d

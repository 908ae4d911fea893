#include "mesher/lattice/lattice_places.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {

LatticePlaces::LatticePlaces(const ImageFrame& image, const LatticeFrame& lattice) : frame_(lattice) {
  // Finer cubes than a few voxels would cost memory and show little more.
  const double least_mm = 4 * std::cbrt(image.spacing_mm.x * image.spacing_mm.y * image.spacing_mm.z);
  for (int level = 0; level <= lattice.max_level; ++level) {
    // A unit more than the tet's extent, so that rounding cannot take a place to the next cube but one.
    levels_.emplace_back(image, std::max(least_mm, lattice.spacing_mm(level) + lattice.unit_mm));
  }
}

void LatticePlaces::clear() {
  for (Cubes& cubes : levels_) {
    cubes.flags.clear();
    cubes.added.clear();
  }
}

void LatticePlaces::add(const Vec3& local_mm) {
  for (Cubes& cubes : levels_) {
    cubes.add(local_mm);
  }
}

void LatticePlaces::Cubes::add(const Vec3& x) {
  const Index3 at = cube_of(x);
  if (added.test(number(at))) {
    return;
  }
  added.set(number(at));
  for (int k = std::max(0, at[2] - 1); k <= std::min(grid.size[2] - 1, at[2] + 1); ++k) {
    for (int j = std::max(0, at[1] - 1); j <= std::min(grid.size[1] - 1, at[1] + 1); ++j) {
      for (int i = std::max(0, at[0] - 1); i <= std::min(grid.size[0] - 1, at[0] + 1); ++i) {
        flags.set(number({i, j, k}));
      }
    }
  }
}

}  // namespace cbc3d

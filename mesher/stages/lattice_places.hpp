// A coarse look-up from places to the red tets that may hold them.
#pragma once

#include <algorithm>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/voxel_bits.hpp"
#include "mesher/stages/lattice.hpp"

namespace cbc3d {

/// Cubes over the image for each level, as long as a red tet of the level at least: a place flags its cube
/// and the 26 round it, so one bit at any node of a tet tells whether a place can be in the tet.
class LatticePlaces {
 public:
  LatticePlaces(const ImageFrame& image, const LatticeFrame& lattice);

  void clear();
  void add(const Vec3& local_mm);

  /// False when no place is in a red tet of the level that has `node` as a node.
  [[nodiscard]] bool may_hold(const LatticePoint& node, int level) const {
    const Cubes& cubes = levels_[static_cast<std::size_t>(level)];
    return cubes.flags.test(cubes.number(cubes.cube_of(frame_.local(node))));
  }

 private:
  struct Cubes {
    Index3 size;
    double edge_mm;
    VoxelBits flags;
    VoxelBits added;  // cubes that hold a place

    /// The cube that holds x; the nearest one for what is outside, which is no farther from any place.
    [[nodiscard]] Index3 cube_of(const Vec3& x) const {
      Index3 cube;
      for (int d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        cube[axis] = std::clamp(static_cast<int>(x[d] / edge_mm), 0, size[axis] - 1);
      }
      return cube;
    }
    [[nodiscard]] std::size_t number(const Index3& c) const {
      return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(size[1]) +
              static_cast<std::size_t>(c[1])) *
                 static_cast<std::size_t>(size[0]) +
             static_cast<std::size_t>(c[0]);
    }
    void add(const Vec3& x);
  };

  LatticeFrame frame_;
  std::vector<Cubes> levels_;
};

}  // namespace cbc3d

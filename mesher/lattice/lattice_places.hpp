// A coarse look-up from places to the red tets that may hold them.
#pragma once

#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/voxel_bits.hpp"
#include "mesher/domain/cubes.hpp"
#include "mesher/lattice/lattice.hpp"

namespace cbc3d {

/// Cubes over the image for each level, as long as a red tet of the level at least: a place flags its cube
/// and the 26 around it, so one bit at any node of a tet shows whether a place can be in the tet.
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
  struct Cubes : ImageCubes {
    Cubes(const ImageFrame& image, double edge) : ImageCubes(image, edge), flags(count()), added(count()) {}
    VoxelBits flags;
    VoxelBits added;  // cubes that hold a place

    void add(const Vec3& x);
  };

  LatticeFrame frame_;
  std::vector<Cubes> levels_;
};

}  // namespace cbc3d

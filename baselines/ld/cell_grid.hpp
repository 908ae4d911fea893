// The cells that the lattice is made of: the voxels of a label image, or equal pieces of them.
//
// Notation: cell           a box with one material: a voxel, or one of the pieces that an elongated voxel is
//                          cut into;
//           lattice point  a corner or centre of cells, as three whole numbers of half cells from the low
//                          corner of cell (0,0,0): corners have even numbers, centres odd ones;
//           margin         layers of background cells before the image's first voxel.
#pragma once

#include <array>
#include <cstdint>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines::ld {

using LatticePoint = std::array<std::int32_t, 3>;

/// Six times the signed volume of a tet, in cubed half cells. Exact for points less than 2^19 apart.
std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                         const LatticePoint& d);

struct CellGridOptions {
  Index3 pieces{1, 1, 1};  ///< cells that a voxel is cut into along each axis, at least 1
  int margin = 0;          ///< layers of background cells around the image, at least 0
  int block = 64;          ///< side of a block in cells, a power of two; the grid consists of whole blocks
};

/// A label image seen as cells. It refers to the image, which must outlive it.
class CellGrid {
 public:
  /// Throws InputError when the image has more cells along an axis than exact arithmetic allows.
  CellGrid(const LabelImage& image, const CellGridOptions& options);

  /// Cells along each axis, a multiple of the side of a block; those outside the image are background.
  [[nodiscard]] const Index3& size() const { return size_; }
  [[nodiscard]] int block() const { return options_.block; }
  /// Edge lengths of a cell.
  [[nodiscard]] const Vec3& cell_mm() const { return cell_mm_; }
  [[nodiscard]] const LabelImage& image() const { return *image_; }
  /// Material of a cell; background outside the image.
  [[nodiscard]] MaterialId at(int i, int j, int k) const {
    return image_->at_or_background(voxel_of(i, 0), voxel_of(j, 1), voxel_of(k, 2));
  }
  /// Materials of the cells (i, j, k) with begin <= i < end.
  void read_row(int begin, int end, int j, int k, MaterialId* materials) const;
  /// Place of a lattice point, local mm of the image.
  [[nodiscard]] Vec3 local_mm(const LatticePoint& point) const;

 private:
  [[nodiscard]] int voxel_of(int cell, std::size_t axis) const {
    const int own = cell - options_.margin;
    return own < 0 ? -1 : options_.pieces[axis] == 1 ? own : own / options_.pieces[axis];
  }

  const LabelImage* image_;
  CellGridOptions options_;
  Index3 size_;
  Vec3 cell_mm_;
};

}  // namespace cbc3d::baselines::ld

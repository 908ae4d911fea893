// The octree of the graded lattice, balanced so that cells that touch differ by one level at most.
#pragma once

#include <vector>

#include "baselines/cleaver/cell_array.hpp"
#include "baselines/cleaver/image_indicators.hpp"
#include "baselines/cleaver/lattice_grid.hpp"

namespace cbc3d::baselines::cleaver {

/// A cell that is not divided.
struct Leaf {
  Index3 cell;  ///< its lowest grid cell
  int level;
};

class Octree {
 public:
  /// Cells of the usual level everywhere.
  static Octree uniform(const LatticeGrid& grid);
  /// Divides each cell within which `sizes` (of cells of the level above the usual one, see sizing_field())
  /// asks for less than its size, and each that reaches across a side of the image where labels are.
  static Octree graded(const LatticeGrid& grid, const CellArray<float>& sizes,
                       const ImageIndicators& indicators);

  /// Divides all cells that hold one of the given grid cells down to level 0. Call balance() after.
  void divide_at(const std::vector<Index3>& grid_cells);
  void balance();

  /// The level of the leaf that holds a grid cell; beyond the grid, that of the nearest one within.
  [[nodiscard]] int level_at(const Index3& grid_cell) const;
  /// All leaves within which or beside which a label may be, in an order that depends on nothing else.
  [[nodiscard]] std::vector<Leaf> leaves_near_labels(const ImageIndicators& indicators) const;
  [[nodiscard]] const LatticeGrid& grid() const { return grid_; }

 private:
  explicit Octree(const LatticeGrid& grid);
  void append_leaves(const Index3& cell, int level, const ImageIndicators& indicators,
                     std::vector<Leaf>& leaves) const;
  void divide_by_sizes(const CellArray<float>& sizes);
  void divide_at_border(const ImageIndicators& indicators);

  LatticeGrid grid_;
  std::vector<CellArray<char>> divided_;  // by level; empty at level 0
};

}  // namespace cbc3d::baselines::cleaver

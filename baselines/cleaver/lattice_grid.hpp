// The grid that all cells of the background lattice are made of.
//
// Notation: a cell of level l has 2^l grid cells along each edge. A lattice vertex is a corner or the centre
// of a cell, so its coordinates are whole numbers of half grid cells.
#pragma once

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines::cleaver {

struct LatticeGrid {
  Vec3 origin_mm;         ///< the lowest corner, local mm
  Vec3 cell_mm;           ///< of a grid cell, nearly a cube
  Index3 cells{0, 0, 0};  ///< grid cells along each axis
  int usual_level = 0;    ///< of cells of size 1 in the sizing field, the smallest that it asks for
  int top_level = 0;      ///< of the largest cells; `cells` are multiples of 2^top_level

  [[nodiscard]] Vec3 place(double x, double y, double z) const {
    return {origin_mm.x + x * cell_mm.x, origin_mm.y + y * cell_mm.y, origin_mm.z + z * cell_mm.z};
  }
  /// Number of cells of a level along each axis.
  [[nodiscard]] Index3 cells_of_level(int level) const {
    return {cells[0] >> level, cells[1] >> level, cells[2] >> level};
  }
};

/// The grid over the labelled part of an image with a margin. Its corners lie on voxel corners; where a label
/// touches the image's border, cells are stretched a little so that whole ones fill the image: then the
/// mesh's flat sides are faces of the lattice. `cell_edge_mm` is the edge of a cell of size 1. Grid cells are
/// halved until none is larger than a voxel in any direction, as far as that is affordable. Throws InputError
/// when no voxel is labelled, JobError when the grid would have too many cells.
LatticeGrid grid_over_labels(const LabelImage& image, double cell_edge_mm);

}  // namespace cbc3d::baselines::cleaver

// How large the lattice's cells may be (Bronson, Levine and Whitaker 2014, section 4): near a boundary no
// larger than its distance from the medial axis, farther from it larger by a Lipschitz constant.
#pragma once

#include "baselines/cleaver/cell_array.hpp"
#include "baselines/cleaver/image_indicators.hpp"
#include "baselines/cleaver/lattice_grid.hpp"

namespace cbc3d::baselines::cleaver {

struct SizingOptions {
  double lipschitz = 0.2;      ///< by which sizes grow with the distance from the boundary, > 0
  double feature_scaling = 1;  ///< factor of all sizes, > 0
};

/// The least size, in cells of size 1, within each cell of the level above the usual one. `materials` is that
/// of the centre of each cell of size 1.
CellArray<float> sizing_field(const CellArray<MaterialId>& materials, const SizingOptions& options);

/// The material at the centre of each cell of size 1.
CellArray<MaterialId> materials_of_cells(const LatticeGrid& grid, const ImageIndicators& indicators);

}  // namespace cbc3d::baselines::cleaver

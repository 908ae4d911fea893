// Which voxel centres the cells of a label hold, where that differs from the image.
#pragma once

#include <cstdint>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// Voxels by their offset in memory, ascending. A cell holds what lies on its border.
struct RelabelledVoxels {
  std::vector<std::size_t> uncovered;  ///< of the material, their centres in no cell of the label
  /// Of another material, their centres in a cell of the label and in none of their own, if that is asked for
  /// too.
  std::vector<std::size_t> overfilled;
};

/// One entry for each of `labels`, pairs of an index into MeshView::labels() and the material it is in the
/// image. Time linear in the cells of these labels, the voxels that they hold, and the image; memory a bit a
/// voxel.
struct RasterLabel {
  std::uint32_t mesh_label;
  MaterialId material;
};
std::vector<RelabelledVoxels> relabelled_voxels(const MeshView& view, const LabelImage& image,
                                                const std::vector<RasterLabel>& labels);

}  // namespace cbc3d::metrics

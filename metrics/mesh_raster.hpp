// Which voxel centres the cells of a label hold, where that differs from the image.
#pragma once

#include <cstdint>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// Voxels by their offset in memory, ascending.
struct RelabelledVoxels {
  std::vector<std::size_t> uncovered;  ///< of the material, their centres in no cell of the label (border included)
  std::vector<std::size_t> overfilled;  ///< of another material, their centres inside a cell of the label
};

/// One entry for each of `labels`, pairs of an index into MeshView::labels() and the material it is in the image. Time
/// linear in the cells of these labels, the voxels that they hold, and the image; memory a bit a voxel.
struct RasterLabel {
  std::uint32_t mesh_label;
  MaterialId material;
};
std::vector<RelabelledVoxels> relabelled_voxels(const MeshView& view, const LabelImage& image,
                                                const std::vector<RasterLabel>& labels);

}  // namespace cbc3d::metrics

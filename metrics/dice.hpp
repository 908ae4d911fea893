// Overlap of mesh and image, voxel by voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// What rasterise() says of a voxel whose centre no cell of a known label holds.
inline constexpr MaterialId kUncovered = 0xFFFF;

/// Material of the cell that holds each voxel's centre. Cells other than tets count as the tets of
/// split_into_tets. A centre on a facet goes to one of the cells at it, always by the same rule: it is taken
/// a millionth of a voxel off its place, and neighbouring tets evaluate the same plane equation. Where cells
/// overlap the lowest material wins. Labels that the image has not, and 0, cover nothing.
std::vector<MaterialId> rasterise(const MeshView& view, const LabelImage& image);

/// Voxel counts of one material.
struct Overlap {
  std::int64_t both = 0, mesh = 0, image = 0;
  /// 2 |A and B| / (|A| + |B|), in [0,1]; 0 for two empty sets.
  [[nodiscard]] double dice() const {
    return mesh + image > 0 ? 2.0 * static_cast<double>(both) / static_cast<double>(mesh + image) : 0.0;
  }
};

/// One entry per material of the image; background's counts stay 0. What rasterise() says, compared slab by
/// slab of about `slab_voxels` voxels, so that memory does not grow with the image.
std::vector<Overlap> count_overlaps(const MeshView& view, const LabelImage& image,
                                    std::size_t slab_voxels = std::size_t{1} << 26U);

}  // namespace cbc3d::metrics

// Stage "Relabeling disconnected regions" (paper, section "Image pre-processing"): face-connected regions of
// a material.
#pragma once

#include <cstddef>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

struct RegionReport {
  std::size_t regions = 0;          ///< face-connected regions of all labelled materials
  std::size_t regions_removed = 0;  ///< those too small, now background
  std::size_t voxels_removed = 0;
  std::size_t materials_added = 0;         ///< regions that became materials of their own
  std::vector<std::size_t> voxels_before;  ///< of each material, before any were removed; removal fills it
};

/// Turns region j of material i to background when |S_ij| / |S_i| < tolerance. (The formula as printed in the
/// paper,
/// (|S_i| - |S_ij|) / |S_i| < tolerance, would remove the regions that are nearly everything; the text says
/// "too small".) A material's largest region is never removed, so no label is lost. Linear in the voxels.
RegionReport remove_small_regions(LabelImage& image, double tolerance);

/// Makes every region but the largest of each material a material of its own with the same label value.
/// Regions beyond the 65535th material stay with their material; the largest come first.
RegionReport split_regions(LabelImage& image);

}  // namespace cbc3d

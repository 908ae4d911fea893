// Which of two materials gives way: the larger.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

enum class BackgroundRank { lowest, highest };

/// The voxels of every material of an image.
struct MaterialVoxels {
  std::vector<std::size_t> count;
  std::vector<std::size_t>
      first;  ///< offset of the first voxel; the number of all voxels where there is none
};
MaterialVoxels count_materials(const LabelImage& image);

/// A rank for every class of materials, all different: the fewer voxels the higher, so that small structures
/// survive; among equals the one whose first voxel comes earlier in raster order is the higher, so that ranks
/// do not depend on label values. Background (class 0) is put first or last. `class_of_material[m]`: the
/// class of material m, 0 for background only.
std::vector<std::uint32_t> rank_by_size(const MaterialVoxels& of_material,
                                        const std::vector<MaterialId>& class_of_material,
                                        BackgroundRank background);

/// The same with every material a class of its own.
std::vector<std::uint32_t> rank_by_size(const MaterialVoxels& of_material, BackgroundRank background);

}  // namespace cbc3d

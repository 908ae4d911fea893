// Which labels of an image a mesh lacks, and their names for a message.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines {

/// The materials, background aside, that have voxels but are not among `found`, ascending.
std::vector<MaterialId> missing_materials(const LabelImage& image, const std::vector<MaterialId>& found);

/// The labels of some materials in words: "label 3", "labels 3, 4", the first ten by their values.
std::string names_of(const LabelImage& image, const std::vector<MaterialId>& materials);

}  // namespace cbc3d::baselines

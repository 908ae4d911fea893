// Images that a case derives from the one it names.
#pragma once

#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

/// Gives every enclosed hole (a background region, by face connectivity, that does not touch the image's
/// border) the label that most of the labelled voxel faces around it have; where several labels have as many,
/// the smallest of them. Returns the number of voxels filled.
std::size_t fill_holes(LabelImage& image);

/// Copies of an image side by side, `copies` (at least 1) of them along each axis: an image of more voxels
/// with the same surface per voxel. Its first copy lies where the image does.
LabelImage repeated(const LabelImage& image, const Index3& copies);

}  // namespace cbc3d::cases

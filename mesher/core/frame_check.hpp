// What the frame of an image must be before anything is computed in it.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Checks the frame that a file or a caller gives, and makes its direction orthonormal to the last digit, for
/// the directions of text headers are rounded. Throws InputError, which begins with `subject`, for a spacing
/// that is not positive, a figure that is not finite, a voxel more than 1000 times as long as thick, and a
/// direction that is singular or sheared by more than 1e-3 (the cosine of the angle between two axes): no
/// orthogonal frame expresses those. With `accept_shear` any shear becomes the nearest orthonormal frame, the
/// orthogonal factor of the polar decomposition (Higham 1986), which leaves the centre of the image in place.
/// `warnings` (or null) gains a line where that moves a voxel centre by more than a tenth of a voxel.
void require_usable_frame(ImageFrame& frame, const std::string& subject, bool accept_shear = false,
                          std::vector<std::string>* warnings = nullptr);

}  // namespace cbc3d

// What the frame of an image must be before anything is computed in it.
#pragma once

#include <string>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Checks the frame that a file or a caller gives, and makes its direction orthonormal to the last digit, for
/// the directions of text headers are rounded. Throws InputError, which begins with `subject`, for a spacing
/// that is not positive, a figure that is not finite, and a direction that is sheared or singular: no
/// orthogonal frame expresses those.
void require_usable_frame(ImageFrame& frame, const std::string& subject);

}  // namespace cbc3d

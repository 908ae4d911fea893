// The weights of CGAL's weighted labelled domain, by which its surfaces lose the steps of the voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines {

/// For every voxel of `image`, with `padding` voxels of background added on every side and x fastest, the
/// largest over all labels of the label's indicator function blurred by a Gaussian of standard deviation
/// `sigma_mm`, as 255 times that (Stalling, Zoeckler and Hege 1998: "Weighted labels for 3D image
/// segmentation"). CGAL 5.5 has a function of its own for it, which blurs along the first axis only.
std::vector<std::uint8_t> label_weights(const LabelImage& image, int padding, double sigma_mm);

}  // namespace cbc3d::baselines

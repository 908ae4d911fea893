// Reading segmented images from files: everything ITK reads (NIfTI, NRRD, MHA/MHD, ...) and INRIMAGE.
#pragma once

#include <filesystem>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Reads a label image with its physical frame. A 4-D header whose last dimension is 1 counts as 3-D; float
/// pixels are accepted when every value is integral. Throws InputError (one line naming file, finding and
/// remedy) for a missing or broken file, a 2-D, colour or fractional image, or one without any labelled
/// voxel.
LabelImage read_label_image(const std::filesystem::path& path);

/// Writes a label image as NIfTI, NRRD or MHA by the extension, in the smallest integer type that holds its
/// labels. Atomic. Throws InputError for an unknown extension, JobError when writing fails.
void write_label_image(const LabelImage& image, const std::filesystem::path& path);

}  // namespace cbc3d

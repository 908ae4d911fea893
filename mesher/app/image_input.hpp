// The image that a command reads, with the options that say what is not refused.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"

namespace cbc3d {

/// What an argument IMAGE may be, for its help.
inline constexpr const char* kImageFormats =
    "label image: NIfTI, NRRD, MHA/MHD, Analyze, INRIMAGE, GIPL, MGH/MGZ, MIF or DICOM SEG";

struct ImageInput {
  ReadImageOptions read;
  bool many_labels = false;           ///< an image that looks grey is taken
  std::vector<std::string> warnings;  ///< of the reading
};

/// Adds --accept-shear, --round and --many-labels.
void add_image_options(CLI::App& command, ImageInput& input);

/// Reads the label image; what was taken for granted is added to the input's warnings. Throws InputError,
/// also for an image that looks grey, unless many labels are meant.
LabelImage read_input_image(const std::string& path, ImageInput& input);

}  // namespace cbc3d

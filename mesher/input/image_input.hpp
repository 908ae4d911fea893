// The image that a command reads: what is not refused, which volume and labels are taken, what they are
// called. The flags of these choices are in input_options.hpp.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/preprocess/choose_labels.hpp"

namespace cbc3d {

/// What an argument IMAGE may be, for its help.
inline constexpr const char* kImageFormats =
    "label image: NIfTI, NRRD, MHA/MHD, Analyze, INRIMAGE, GIPL, MGH/MGZ, MIF or DICOM SEG";

struct ImageInput {
  ReadImageOptions read{};
  bool many_labels = false;  ///< an image that looks grey is taken
  bool long_work = false;    ///< a small file that asks for minutes of work is meshed
  std::string names_file{};  ///< a table of names; empty: the image's own, or the table beside it
  LabelChoice choice{};
  LabelNames names{};                   ///< of the labels that are taken; known once the image is read
  std::vector<std::string> warnings{};  ///< of the reading
};

/// Reads the label image, its names and those of a table, and takes what was chosen; what was taken for
/// granted is added to the input's warnings. Names come from the table that was asked for, otherwise from the
/// image's file and, for labels that it does not name, from a table beside it (table_beside()); such a table
/// that cannot be read is a warning. Throws InputError, also for an image that looks grey, unless many labels
/// are meant.
LabelImage read_input_image(const std::string& path, ImageInput& input);

}  // namespace cbc3d

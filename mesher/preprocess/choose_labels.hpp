// Which labels of an image are meshed, and which value is its background.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/label_names.hpp"

namespace cbc3d {

struct LabelChoice {
  std::vector<Label> background{};  ///< values that are background; empty: 0
  std::vector<Label> labels{};      ///< labels that are kept; empty: all
  bool keep_rest = false;           ///< the other labels become one label instead of background
};

/// Applies a choice, first the background, then the labels. Where 0 is not among the background values, its
/// voxels get the first of these as their label, for 0 is the number of background in meshes. With
/// `keep_rest` the labels that are not chosen become one label, one above the largest of the image, named
/// "rest". `names` follows; `warnings` gains a line for every label that came into being. Throws InputError,
/// which begins with `subject` ("'a.nrrd'"), for a label that the image lacks, naming those it has, for 0
/// among the chosen ones, `keep_rest` without labels, and a choice that leaves nothing.
void choose_labels(LabelImage& image, LabelNames& names, const LabelChoice& choice,
                   const std::string& subject, std::vector<std::string>& warnings);

/// "1, 2, 5", of more than twenty labels the first twenty and how many others there are.
std::string labels_text(const std::vector<Label>& labels);

}  // namespace cbc3d

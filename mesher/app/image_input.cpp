#include "mesher/app/image_input.hpp"

#include "mesher/core/error.hpp"
#include "mesher/preprocess/grey_check.hpp"

namespace cbc3d {

void add_image_options(CLI::App& command, ImageInput& input) {
  constexpr const char* kGroup = "Input image";
  command
      .add_flag("--accept-shear", input.read.accept_shear,
                "take the nearest orthogonal frame of an image whose axes are sheared by more than 1e-3")
      ->group(kGroup);
  command
      .add_flag("--round", input.read.round_values,
                "take values within 1e-4 of an integer as that integer, of images of floats")
      ->group(kGroup);
  command
      .add_flag(
          "--many-labels", input.many_labels,
          "take an image that looks grey (more than 30 labels, and 5 % of the voxels without a neighbour of "
          "their label or half of the neighbours unlike) or like noise (half of the voxels without one, or a "
          "contact at an edge for every ten voxels)")
      ->group(kGroup);
}

LabelImage read_input_image(const std::string& path, ImageInput& input) {
  LabelImage image = read_label_image(path, input.read, &input.warnings);
  const std::string reason = input.many_labels ? "" : why_grey(image);
  if (!reason.empty()) {
    throw InputError("'" + path + "': " + reason +
                     "; segment it first (cbc3d segment), or many_labels takes it");
  }
  return image;
}

}  // namespace cbc3d

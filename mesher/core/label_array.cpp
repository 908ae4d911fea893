#include "mesher/core/label_array.hpp"

#include <algorithm>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/frame_check.hpp"
#include "mesher/core/label_classifier.hpp"

namespace cbc3d {
namespace {

constexpr const char* kSubject = "the label array";

void require_size(const ImageFrame& frame, std::size_t values) {
  const auto& size = frame.size;
  const std::string shape =
      std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
  if (std::min({size[0], size[1], size[2]}) < 1) {
    throw InputError(
        std::string(kSubject) + ": its size is " + shape + "; give a positive number along each axis",
        "size");
  }
  if (frame.voxel_count() != values) {
    throw InputError(std::string(kSubject) + ": it has " + std::to_string(values) +
                         " values, but its size is " + shape + "; give one value for each voxel",
                     "size");
  }
}

}  // namespace

LabelImage to_label_image(const LabelArray& labels, const ImageFrame& frame) {
  LabelImage image;
  image.frame = frame;
  std::visit(
      [&image](const auto& values) {
        require_size(image.frame, values.size());
        require_usable_frame(image.frame, kSubject);
        Classifier classifier(values.data(), values.size(), kSubject);
        classifier.find_labels(image);
        image.voxels = classifier.voxels();
      },
      labels);
  if (image.labels.size() < 2) {
    throw InputError(std::string(kSubject) + ": every voxel is background (0); there is nothing to mesh",
                     "labels");
  }
  return image;
}

}  // namespace cbc3d

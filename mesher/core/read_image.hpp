// Reading images from files: NIfTI-1 and -2, Analyze, NRRD, MetaImage, INRIMAGE, GIPL, MGH, MIF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// A grey image with its frame.
struct GreyImage {
  ImageFrame frame;
  std::vector<float> values;  ///< i fastest
};

/// Reads a grey image, with the checks of read_label_image. Throws InputError.
GreyImage read_grey_image(const std::filesystem::path& path, const ReadImageOptions& options = {});

/// The name of a file's format, as its users call it. Throws InputError.
std::string format_of_image(const std::filesystem::path& path);

/// Bytes on the disk of all files that an image is made of: its header's and those of its voxels. Throws
/// InputError.
std::uintmax_t file_bytes_of_image(const std::filesystem::path& path);

}  // namespace cbc3d

// The INRIMAGE-4 format (.inr, .inr.gz), in which CGAL ships its example images.
#pragma once

#include <filesystem>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// True for *.inr and *.inr.gz.
bool has_inrimage_extension(const std::filesystem::path& path);

/// The values of an INRIMAGE file with the frame that its header gives (direction: identity).
struct InrimageVolume {
  ImageFrame frame;
  std::vector<double> values;
};

/// Reads a scalar INRIMAGE volume (plain or gzipped; 8, 16 or 32-bit integers, 32 or 64-bit floats, either
/// byte order). Throws InputError.
InrimageVolume read_inrimage(const std::filesystem::path& path);

}  // namespace cbc3d

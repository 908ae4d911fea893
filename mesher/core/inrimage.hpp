// The INRIMAGE-4 format (.inr, .inr.gz), in which CGAL ships its example images.
#pragma once

#include <filesystem>

#include "mesher/core/label_image.hpp"
#include "mesher/core/packed_voxels.hpp"

namespace cbc3d {

/// True for *.inr and *.inr.gz.
bool has_inrimage_extension(const std::filesystem::path& path);

/// The voxels of an INRIMAGE file, in this machine's byte order, with the frame that its header gives
/// (direction: identity).
struct InrimageVolume {
  enum class Voxel { uint8, int8, uint16, int16, uint32, int32, float32, float64 };
  ImageFrame frame;
  Voxel type = Voxel::uint8;
  VoxelBytes bytes;
};

/// Reads a scalar INRIMAGE volume (plain or gzipped; 8, 16 or 32-bit integers, 32 or 64-bit floats, either
/// byte order). Throws InputError.
InrimageVolume read_inrimage(const std::filesystem::path& path);

}  // namespace cbc3d

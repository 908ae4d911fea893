// The voxels of an image file: as many bytes as its header promises, or none at all.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// Compares, before any memory is asked for, the lengths of the files with what the header promises: exactly
/// for uncompressed voxels, by what the compression can do at most for others. Zeros behind the last voxel
/// are padding and make a warning of the header, other bytes a fault. Throws FormatError.
void require_plausible_length(ImageHeader& header);

/// How many bytes read_voxels wants in front of the voxels: a gzip file is decompressed at once, its header
/// too. Small, and a multiple of 8.
std::size_t lead_bytes(const ImageHeader& header);

/// Fills the end of `buffer`, which has lead_bytes() and voxel_bytes(), with the voxels in this machine's
/// byte order. Throws FormatError when a file has fewer or more bytes than the header promises or is damaged.
void read_voxels(ImageHeader& header, std::span<std::uint8_t> buffer);

/// Where the voxels lie in the one file that holds them as they are in memory: uncompressed, aligned and in
/// this machine's byte order; none where they do not.
std::optional<std::uint64_t> offset_in_place(const ImageHeader& header);

}  // namespace cbc3d::formats

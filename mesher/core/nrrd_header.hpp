// Where the voxels of an NRRD file are, by its header.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace cbc3d {

/// The offset of the first voxel when the voxels follow the header in one of these encodings and, if they
/// have more than one byte each, in this machine's byte order; 0 otherwise.
std::size_t nrrd_voxel_offset(const std::filesystem::path& path, std::size_t component_bytes,
                              std::initializer_list<std::string_view> encodings);

}  // namespace cbc3d

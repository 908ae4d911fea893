// What the header of a NRRD file says of where its voxels are.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace cbc3d {

/// Where the voxels begin if they follow the header, in one of these encodings and, of more than a byte each,
/// in this machine's order of bytes; 0 otherwise.
std::size_t nrrd_voxel_offset(const std::filesystem::path& path, std::size_t component_bytes,
                              std::initializer_list<std::string_view> encodings);

}  // namespace cbc3d

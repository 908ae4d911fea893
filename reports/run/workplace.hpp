// Where the bench finds its programs, manifests and images.
#pragma once

#include <filesystem>
#include <vector>

namespace cbc3d::reports {

/// This executable's file, symbolic links resolved. Throws JobError where /proc is not mounted.
std::filesystem::path executable_file();
/// The folder of this executable, in which the meshers' programs lie too. Throws as above.
std::filesystem::path bin_dir();
/// The folder of the case manifests, PREFIX/share/cbc3d/cases. Throws InputError when it is not there.
std::filesystem::path manifest_dir();
/// Folders in which case images are looked for: the given ones, those in CBC3D_DATA (separated by colons),
/// and PREFIX/data. Throws InputError when a given one is no folder.
std::vector<std::filesystem::path> data_dirs(const std::vector<std::filesystem::path>& given);

}  // namespace cbc3d::reports

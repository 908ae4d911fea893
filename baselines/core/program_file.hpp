// Where the running program lies.
#pragma once

#include <filesystem>

namespace cbc3d::baselines {

/// The file of the running program, symbolic links resolved. Throws JobError where /proc is not mounted.
std::filesystem::path program_file();

}  // namespace cbc3d::baselines

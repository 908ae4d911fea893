// --coordinates of the commands that write meshes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cbc3d {

/// Adds --coordinates lps|ras|voxel; `coordinates` becomes what files state: LPS, RAS or voxel.
void add_coordinates_option(CLI::App& command, std::string& coordinates);

}  // namespace cbc3d

// `cbc3d tile`: 2-D slices made one volume.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

void add_tile_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

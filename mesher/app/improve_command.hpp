// `cbc3d improve`: the improver and decimator alone, on any labelled tet mesh.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

/// Adds the command to `app`; its callback sets `exit_code`.
void add_improve_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

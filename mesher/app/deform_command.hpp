// `cbc3d deform`: the deformation alone, and the mixed elements alone, on a given mesh.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

/// Adds the command to `app`; its callback sets `exit_code`.
void add_deform_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

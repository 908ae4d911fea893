// `cbc3d surface`: the surfaces of a labelled volume mesh as triangles.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

/// Adds the subcommand; when it is called it runs and sets `exit_code`. Throws InputError, JobError.
void add_surface_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

// `cbc3d clean`: the image pre-processing alone.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

/// Adds the subcommand; when it is called it runs and sets `exit_code`. Throws InputError and JobError.
void add_clean_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

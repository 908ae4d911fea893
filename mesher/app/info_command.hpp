// `cbc3d info`: what the reader makes of an image.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

/// Adds the subcommand; when it is called it runs and sets `exit_code`. Throws InputError.
void add_info_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

// `cbc3d segment`: from a grey image to labels.
#pragma once

#include <CLI/CLI.hpp>

namespace cbc3d {

void add_segment_command(CLI::App& app, int& exit_code);

}  // namespace cbc3d

// Completions of a program's commands and options for shells.
#pragma once

#include <string>
#include <vector>

#include "mesher/command_line/command_tree.hpp"

namespace cbc3d {

/// "bash", "zsh" and "fish".
std::vector<std::string> completed_shells();

/// A script for one of the shells: commands, then the options of each, the choices of options that have some,
/// and files elsewhere.
std::string shell_completion(const CommandTree& tree, const std::string& shell);

}  // namespace cbc3d

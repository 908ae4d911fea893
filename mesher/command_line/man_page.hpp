// A man page of a program's commands and options.
#pragma once

#include <string>

#include "mesher/command_line/command_tree.hpp"
#include "mesher/command_line/program_help.hpp"

namespace cbc3d {

/// The page in the language of man(7), section 1. It has no date, so that the same program writes the same
/// bytes.
std::string man_page(const CommandTree& tree, const ProgramHelp& help);

}  // namespace cbc3d

// The commands and options of a program, as its parser has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cbc3d {

struct CommandOption {
  std::vector<std::string> flags;    ///< "--out", "-h"; empty for an argument without a flag
  std::string value;                 ///< stands for the value: "MM", "FILE"; empty for a switch
  std::vector<std::string> choices;  ///< where the value is one of some names
  std::string text;                  ///< what it does
  std::string group;                 ///< heading; "Options" where it has none of its own
  bool required = false;
};

struct CommandTree {
  std::string name;
  std::string text;
  std::vector<CommandOption> options;  ///< in the parser's order
  std::vector<CommandTree> commands;
};

/// `name` is the program's. Options that the parser hides are left out.
CommandTree command_tree(const CLI::App& app, const std::string& name);

/// The beginning of a text, up to the end of its first clause and a blank before `most` bytes.
std::string first_clause(const std::string& text, std::size_t most);

}  // namespace cbc3d

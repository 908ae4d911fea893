// Help that every program has: examples, a man page and completions.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cbc3d {

struct Example {
  std::string command;
  std::string text;  ///< what it does, one line
};

struct ProgramHelp {
  std::string name;  ///< of the program
  std::string version;
  std::string summary;  ///< one line without a full stop
  std::vector<Example> examples;
  std::vector<std::string> exit_codes;  ///< what each means, from 0 on
};

/// The examples as they stand below the options of --help.
std::string examples_text(const std::vector<Example>& examples);

/// Adds the examples to the parser's help, and --man and --completion SHELL, which print a man page or a
/// completion and end the program by CLI::Success. Both know what the parser has when they are called.
void add_program_help(CLI::App& app, const ProgramHelp& help);

}  // namespace cbc3d

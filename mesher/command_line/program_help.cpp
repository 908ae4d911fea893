#include "mesher/command_line/program_help.hpp"

#include <iostream>

#include "mesher/command_line/command_tree.hpp"
#include "mesher/command_line/man_page.hpp"
#include "mesher/command_line/shell_completion.hpp"

namespace cbc3d {

std::string examples_text(const std::vector<Example>& examples) {
  std::string text = "Examples:";
  for (const Example& example : examples) {
    text += "\n  " + example.command + "\n      " + example.text;
  }
  return text;
}

void add_program_help(CLI::App& app, const ProgramHelp& help) {
  app.footer(examples_text(help.examples));
  app.add_flag_callback(
      "--man",
      [&app, help] {
        std::cout << man_page(command_tree(app, help.name), help);
        throw CLI::Success();
      },
      "Print the man page and exit");
  app.add_option_function<std::string>(
         "--completion",
         [&app, help](const std::string& shell) {
           std::cout << shell_completion(command_tree(app, help.name), shell);
           throw CLI::Success();
         },
         "Print the completion for a shell and exit: source <(" + help.name + " --completion bash)")
      ->type_name("SHELL")
      ->check(CLI::IsMember(completed_shells()));
}

}  // namespace cbc3d

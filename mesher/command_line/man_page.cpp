#include "mesher/command_line/man_page.hpp"

#include <algorithm>

namespace cbc3d {
namespace {

/// A text as roff has it: hyphens are minus signs, for they are typed, and no line begins with a control
/// character.
std::string escaped(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    begins = c == '\n';
  }
  return out;
}

std::string option_entry(const CommandOption& option) {
  std::string flags;
  for (const std::string& flag : option.flags) {
    flags += (flags.empty() ? "\\fB" : ", \\fB") + escaped(flag) + "\\fR";
  }
  const std::string value = option.value.empty() ? "" : "\\fI" + escaped(option.value) + "\\fR";
  return ".TP\n" + flags + (flags.empty() || value.empty() ? "" : " ") + value + "\n" + escaped(option.text) +
         (option.required ? " (required)" : "") + "\n";
}

/// The options below the headings of their groups, in the order of the groups' first options.
std::string option_entries(const std::vector<CommandOption>& options) {
  std::vector<std::string> groups;
  for (const CommandOption& option : options) {
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.push_back(option.group);
  }
  std::string text;
  for (const std::string& group : groups) {
    text += ".PP\n" + escaped(group) + ":\n";
    for (const CommandOption& option : options) {
      if (option.group == group) text += option_entry(option);
    }
  }
  return text;
}

std::string synopsis(const CommandTree& command, const std::string& program) {
  std::string text = ".B " + escaped(program + " " + command.name) + "\n";
  for (const CommandOption& option : command.options) {
    if (option.flags.empty()) {
      text +=
          option.required ? ".I " + escaped(option.value) + "\n" : ".RI [ " + escaped(option.value) + " ]\n";
    } else if (option.required) {
      text += ".BI " + escaped(option.flags.front()) + " \" " + escaped(option.value) + "\"\n";
    }
  }
  return text + "[options]\n.br\n";
}

std::string command_section(const CommandTree& command, const std::string& program) {
  return ".SS " + escaped(program + " " + command.name) + "\n" + escaped(command.text) + "\n" +
         option_entries(command.options);
}

std::string example_entries(const std::vector<Example>& examples) {
  std::string text;
  for (const Example& example : examples) {
    text += ".TP\n\\fB" + escaped(example.command) + "\\fR\n" + escaped(example.text) + "\n";
  }
  return text;
}

std::string exit_entries(const std::vector<std::string>& exit_codes) {
  std::string text;
  for (std::size_t code = 0; code < exit_codes.size(); ++code) {
    text += ".TP\n" + std::to_string(code) + "\n" + escaped(exit_codes[code]) + "\n";
  }
  return text;
}

}  // namespace

std::string man_page(const CommandTree& tree, const ProgramHelp& help) {
  std::string title = help.name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  std::string text = ".TH \"" + escaped(title) + "\" 1 \"\" \"" + help.name + " " + help.version +
                     "\" \"User Commands\"\n.SH NAME\n" + escaped(help.name) + " \\- " +
                     escaped(help.summary) + "\n.SH SYNOPSIS\n";
  for (const CommandTree& command : tree.commands) text += synopsis(command, help.name);
  text += ".SH DESCRIPTION\n" + escaped(tree.text) + "\n" + option_entries(tree.options) + ".SH COMMANDS\n";
  for (const CommandTree& command : tree.commands) text += command_section(command, help.name);
  return text + ".SH EXIT STATUS\n" + exit_entries(help.exit_codes) + ".SH EXAMPLES\n" +
         example_entries(help.examples);
}

}  // namespace cbc3d

#include "mesher/command_line/shell_completion.hpp"

#include <algorithm>

namespace cbc3d {
namespace {

constexpr std::size_t kLongestText = 72;

/// The program's name as that of a shell function.
std::string function_name(const std::string& program) {
  std::string name = "_" + program;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : " ") + part;
  }
  return text;
}

std::string names_of(const std::vector<CommandTree>& commands) {
  std::string names;
  for (const CommandTree& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

std::string flags_of(const std::vector<CommandOption>& options) {
  std::vector<std::string> flags;
  for (const CommandOption& option : options) {
    flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  }
  return joined(flags);
}

/// `text` with `before` in front of every one of the characters.
std::string with_escapes(const std::string& text, const std::string& characters, const std::string& before) {
  std::string out;
  for (const char c : text) {
    out += (characters.find(c) != std::string::npos ? before : "") + c;
  }
  return out;
}

/// Within single quotes of sh.
std::string quoted(std::string text) {
  for (std::size_t at = text.find('\''); at != std::string::npos; at = text.find('\'', at + 4)) {
    text.replace(at, 1, "'\\''");
  }
  return "'" + text + "'";
}

// bash: lists of words by command; what follows an option with choices is one of them.

std::string bash_choices(const CommandTree& command) {
  std::string text;
  for (const CommandOption& option : command.options) {
    if (!option.choices.empty()) {
      text += "    '" + command.name + " " + option.flags.back() + "') words='" + joined(option.choices) +
              "' ;;\n";
    }
  }
  return text;
}

std::string bash(const CommandTree& tree) {
  const std::string function = function_name(tree.name);
  std::string options, choices;
  for (const CommandTree& command : tree.commands) {
    options += "    " + command.name + ") words='" + flags_of(command.options) + "' ;;\n";
    choices += bash_choices(command);
  }
  return "# Completion of " + tree.name + " for bash.\n" + function +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} "
         "words=''\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         names_of(tree.commands) + " " + flags_of(tree.options) +
         "' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case \"$command $before\" in\n" +
         choices +
         "  esac\n"
         "  if [ -z \"$words\" ] && [[ $word == -* ]]; then\n"
         "    case \"$command\" in\n" +
         options +
         "    esac\n"
         "  fi\n"
         "  if [ -n \"$words\" ]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F " +
         function + " " + tree.name + "\n";
}

// zsh: _arguments of each command, with texts.

std::string zsh_option(const CommandOption& option) {
  const std::string text = with_escapes(first_clause(option.text, kLongestText), "[]:\\", "\\");
  std::string value;
  if (!option.choices.empty()) {
    value = ":value:(" + joined(option.choices) + ")";
  } else if (!option.value.empty()) {
    value = ":" + with_escapes(option.value, ":[]", "\\") + ":_files";
  }
  std::string lines;
  for (const std::string& flag : option.flags) {
    lines += "        " + quoted("*" + flag + "[" + text + "]" + value) + " \\\n";
  }
  return lines;
}

std::string zsh(const CommandTree& tree) {
  const std::string function = function_name(tree.name);
  std::string names, cases;
  for (const CommandTree& command : tree.commands) {
    names += "    " +
             quoted(command.name + ":" + with_escapes(first_clause(command.text, kLongestText), ":", "\\")) +
             "\n";
    cases += "    " + command.name + ")\n      _arguments \\\n";
    for (const CommandOption& option : command.options) cases += zsh_option(option);
    cases += "        '*:file:_files'\n      ;;\n";
  }
  return "#compdef " + tree.name + "\n# Completion of " + tree.name + " for zsh.\n" + function +
         "() {\n  local -a commands\n  commands=(\n" + names +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe command commands\n"
         "    compadd -- " +
         flags_of(tree.options) +
         "\n    return\n"
         "  fi\n"
         "  case $words[2] in\n" +
         cases + "  esac\n}\n" + function + " \"$@\"\n";
}

// fish: one line for each flag.

std::string fish_option(const CommandOption& option, const std::string& begin) {
  std::string flags;
  for (const std::string& flag : option.flags) {
    flags += flag.rfind("--", 0) == 0 ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
  }
  if (flags.empty()) return "";
  std::string value;
  if (!option.choices.empty()) {
    value = " -x -a " + quoted(joined(option.choices));
  } else if (!option.value.empty()) {
    value = " -r";
  }
  // In single quotes of fish a backslash stands before quotes and backslashes.
  return begin + flags + value + " -d '" +
         with_escapes(first_clause(option.text, kLongestText), "'\\", "\\") + "'\n";
}

std::string fish(const CommandTree& tree) {
  const std::string program = "complete -c " + tree.name;
  std::string text = "# Completion of " + tree.name + " for fish.\n";
  for (const CommandOption& option : tree.options) {
    text += fish_option(option, program + " -n __fish_use_subcommand");
  }
  for (const CommandTree& command : tree.commands) {
    text += program + " -n __fish_use_subcommand -f -a " + command.name + " -d '" +
            with_escapes(first_clause(command.text, kLongestText), "'\\", "\\") + "'\n";
    for (const CommandOption& option : command.options) {
      text += fish_option(option, program + " -n '__fish_seen_subcommand_from " + command.name + "'");
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> completed_shells() {
  return {"bash", "zsh", "fish"};
}

std::string shell_completion(const CommandTree& tree, const std::string& shell) {
  return shell == "bash" ? bash(tree) : shell == "zsh" ? zsh(tree) : fish(tree);
}

}  // namespace cbc3d

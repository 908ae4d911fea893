#include "mesher/command_line/command_tree.hpp"

#include <algorithm>
#include <sstream>

namespace cbc3d {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

/// Of "a|b|c" and of CLI11's "TEXT:{a,b,c}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos) {
    return split(type.substr(open + 1, close - open - 1), ',');
  }
  return type.find('|') != std::string::npos ? split(type, '|') : std::vector<std::string>();
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : "|") + name;
  }
  return text;
}

CommandOption described(const CLI::Option& option) {
  CommandOption described;
  for (const std::string& name : option.get_snames()) described.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) described.flags.push_back("--" + name);
  if (option.get_positional()) {
    described.value = option.get_name(true);
  } else if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();
    described.choices = choices_of(type);
    described.value = described.choices.empty() ? type.substr(0, type.find(':')) : joined(described.choices);
  }
  described.text = option.get_description();
  described.group = option.get_group();
  described.required = option.get_required();
  return described;
}

}  // namespace

CommandTree command_tree(const CLI::App& app, const std::string& name) {
  CommandTree tree{.name = name, .text = app.get_description(), .options = {}, .commands = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) {
      tree.options.push_back(described(*option));
    }
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    tree.commands.push_back(command_tree(*command, command->get_name()));
  }
  return tree;
}

std::string first_clause(const std::string& text, std::size_t most) {
  std::string clause = text.substr(0, text.find_first_of(";[\n"));
  if (clause.size() > most) {
    clause.resize(std::min(clause.rfind(' ', most), most));
  }
  while (!clause.empty() && (clause.back() == ' ' || clause.back() == ',')) {
    clause.pop_back();
  }
  return clause;
}

}  // namespace cbc3d

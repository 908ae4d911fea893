#include "mesher/app/option_flags.hpp"

#include <algorithm>

#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

/// A default under the label of its column.
using Entry = std::pair<std::string, std::string>;

std::string defaults_text(const OptionRow& row, const std::vector<DefaultColumn>& columns) {
  std::vector<Entry> entries;
  for (const DefaultColumn& column : columns) {
    if (has_option(column.options, row)) {
      entries.emplace_back(column.label,
                           default_text(row, column.options, frame_of_defaults().voxel_diagonal_mm()));
    }
  }
  const auto is_same = [&](const Entry& entry) { return entry.second == entries.front().second; };
  if (std::all_of(entries.begin(), entries.end(), is_same)) {
    return entries.empty() ? "" : entries.front().second;
  }
  std::string text;
  for (const auto& [label, value] : entries) {
    text += (text.empty() ? "" : ", ") + label + ": " + value;
  }
  return text;
}

std::string help_text(const OptionRow& row, const std::vector<DefaultColumn>& columns) {
  std::string text = row.text;
  if (row.kind == OptionKind::number || row.kind == OptionKind::count ||
      row.kind == OptionKind::label_numbers) {
    text += "; " + range_text(row) + (row.unit.empty() ? "" : " " + row.unit);
  }
  if (row.kind == OptionKind::label_numbers) {
    text += ", repeatable";
  }
  return text + " [" + defaults_text(row, columns) + "]";
}

std::string placeholder(const OptionRow& row) {
  std::string text = row.symbol;
  for (const std::string& name : row.choices) {
    text += (text.empty() ? "" : "|") + name;
  }
  return text;
}

CLI::Option* add_flag(CLI::App& command, const OptionRow& row, const std::string& help,
                      OptionSettings& settings) {
  if (row.kind == OptionKind::on_off) {
    CLI::Option* flag = command.add_flag_function(
        "--" + row.name, [&](std::int64_t count) { settings.emplace_back(row.name, count > 0); }, help);
    // --NAME=TEXT is allowed too, for a switch that the preset has on.
    return flag->check([&row](const std::string& text) {
      checked_value(row, text);
      return std::string();
    });
  }
  const auto take = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      settings.emplace_back(row.name, checked_value(row, text));
    }
  };
  CLI::Option* option = command.add_option_function<std::vector<std::string>>("--" + row.name, take, help);
  option->type_name(placeholder(row));
  return row.kind == OptionKind::label_numbers ? option->allow_extra_args(false) : option->expected(1);
}

}  // namespace

ImageFrame frame_of_defaults() {
  return {};
}

std::vector<DefaultColumn> preset_columns() {
  std::vector<DefaultColumn> columns;
  for (const std::string& name : preset_names()) {
    columns.push_back({name, preset_options(name, frame_of_defaults())});
  }
  return columns;
}

std::vector<DefaultColumn> deformation_columns() {
  std::vector<DefaultColumn> columns;
  for (const std::string& name : preset_names()) {
    columns.push_back({name, deformation_preset_options(name)});
  }
  return columns;
}

void add_option_flag(CLI::App& command, const OptionRow& row, const std::vector<DefaultColumn>& columns,
                     OptionSettings& settings) {
  add_flag(command, row, help_text(row, columns), settings);
}

void add_option_flags(CLI::App& command, OptionGroup group, const std::vector<DefaultColumn>& columns,
                      OptionSettings& settings) {
  for (const OptionRow& row : option_table()) {
    if (row.group == group) {
      add_flag(command, row, help_text(row, columns), settings)->group(heading(group));
    }
  }
}

}  // namespace cbc3d

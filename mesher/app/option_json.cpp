#include "mesher/app/option_json.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/app/option_flags.hpp"
#include "mesher/input/input_json.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

const char* kind_name(OptionKind kind) {
  switch (kind) {
    case OptionKind::number:
      return "number";
    case OptionKind::count:
      return "count";
    case OptionKind::on_off:
      return "switch";
    case OptionKind::choice:
      return "enumeration";
    case OptionKind::label_numbers:
      return "label_numbers";
  }
  return "";
}

const char* group_name(OptionGroup group) {
  switch (group) {
    case OptionGroup::cleaning:
      return "cleaning";
    case OptionGroup::lattice:
      return "lattice";
    case OptionGroup::mixed:
      return "mixed";
    case OptionGroup::improvement:
      return "improvement";
    case OptionGroup::deformation:
      return "deformation";
  }
  return "";
}

struct ValueJson {
  template <typename Value>
  nlohmann::json operator()(const Value& value) const {
    return value;
  }
  nlohmann::json operator()(const LabelNumbers& numbers) const {
    nlohmann::json by_label = nlohmann::json::object();
    for (const auto& [label, number] : numbers) {
      by_label[std::to_string(label)] = number;
    }
    return by_label;
  }
};

nlohmann::json value_json(const OptionRow& row, const MeshImageOptions& options) {
  if (row.kind == OptionKind::number && is_unset(row, options)) {
    return nullptr;
  }
  return std::visit(ValueJson{}, row.get(options));
}

/// Puts the values of one option of labels beside those of the others that share its key.
void merge_by_label(nlohmann::json& merged, const OptionRow& row, const nlohmann::json& by_label) {
  merged.update(nlohmann::json::object());
  for (const auto& [label, value] : by_label.items()) {
    merged[label][row.label_key] = value;
  }
}

nlohmann::json range_json(const OptionRow& row) {
  if (row.kind == OptionKind::on_off || row.kind == OptionKind::choice) {
    return nullptr;
  }
  return {{"lowest", row.range.lowest},
          {"highest", std::isinf(row.range.highest) ? nlohmann::json() : nlohmann::json(row.range.highest)},
          {"excludes_lowest", row.range.excludes_lowest},
          {"excludes_highest", row.range.excludes_highest}};
}

nlohmann::json description(const OptionRow& row, const MeshImageOptions& preset) {
  const bool in_words = is_unset(row, preset) || row.scales_with_voxels;
  return {{"name", row.name},
          {"group", group_name(row.group)},
          {"kind", kind_name(row.kind)},
          {"symbol", row.symbol},
          {"unit", row.unit},
          {"default", in_words ? nlohmann::json() : value_json(row, preset)},
          {"default_text", default_text(row, preset, frame_of_defaults().voxel_diagonal_mm())},
          {"range", range_json(row)},
          {"values", row.choices},
          {"text", row.text}};
}

nlohmann::json preset_description(const std::string& name, bool mixed) {
  MeshImageOptions preset = preset_options(name, frame_of_defaults());
  preset.mixed = mixed;
  nlohmann::json options = nlohmann::json::array();
  for (const OptionRow& row : option_table()) {
    if (has_option(preset, row)) {
      options.push_back(description(row, preset));
    }
  }
  return {{"preset", name}, {"mixed", mixed}, {"options", options}};
}

}  // namespace

nlohmann::json options_json(const MeshImageOptions& options, const MeshImageOptions& preset,
                            const std::vector<OptionGroup>& groups) {
  nlohmann::json json = nlohmann::json::object();
  for (const OptionRow& row : option_table()) {
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end() || !has_option(preset, row)) {
      continue;
    }
    nlohmann::json value = value_json(row, options);
    if (row.negates_field) {
      value = !value.get<bool>();
    }
    if (row.label_key.empty()) {
      json[report_key(row)] = value;
    } else {
      merge_by_label(json[report_key(row)], row, value);
    }
  }
  return json;
}

nlohmann::json describe_options() {
  nlohmann::json presets = nlohmann::json::array();
  for (const std::string& name : preset_names()) {
    for (const bool mixed : {false, true}) {
      presets.push_back(preset_description(name, mixed));
    }
  }
  return {{"presets", presets}, {"input", describe_input_options()}};
}

}  // namespace cbc3d
